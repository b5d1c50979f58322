"""Does the reader agree with the programs on what they write now? `PM_BIN` names the folder of the programs."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from .test_golden import read

MAPS = ["kd", "kd --reread", "kd --pad", "bucket-kd", "bucket-kd --line 320 --carry", "wide", "vvh", "kdb", "grid", "block-hash"]


@unittest.skipUnless("PM_BIN" in os.environ, "PM_BIN names no folder of programs")
class Programs(unittest.TestCase):
    def run_in(self, folder, line):
        program, *arguments = line.split()
        command = [str(pathlib.Path(os.environ["PM_BIN"]).resolve() / program), *arguments]
        return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout

    def agrees(self, folder, name):
        records, accesses, digest = read(f"{folder}/{name}")
        told = self.run_in(folder, f"pm-view -q {name}").replace(",", "")
        self.assertIn(digest, told, name)
        numbers = dict(re.findall(r"^(records|accesses) +([0-9]+)", told, re.MULTILINE))
        self.assertEqual(int(numbers["records"]), records, name)
        if accesses is not None:
            self.assertEqual(int(numbers["accesses"]), accesses, name)

    def test_streams_of_today(self):
        with tempfile.TemporaryDirectory() as folder:
            self.run_in(folder, "pm-photons -q -n 5000 -o map.pmp")
            self.run_in(folder, "pm-queries -q --size 20x20 --gathers 9 --order tiled --irradiance-cache 0.2 -o cached.pmq")
            self.run_in(folder, "pm-queries -q --size 20x20 --gathers 4 -o q.pmq")
            self.run_in(folder, "pm-reorder -q hilbert q.pmq -o h.pmq")
            self.run_in(folder, "pm-photons -q -n 5000 --part 1/2 -o part.pmp")
            for name in ("map.pmp", "cached.pmq", "q.pmq", "h.pmq", "part.pmp"):
                self.agrees(folder, name)
            for options in MAPS:
                self.run_in(folder, f"pm-gather -q map.pmp h.pmq -k 20 --map {options} -o t.pmt")
                self.agrees(folder, "t.pmt")
                self.run_in(folder, "pm-view -q --archive t.pmt -o kept.pmt")
                self.agrees(folder, "kept.pmt")
            # Addresses that nobody laid out, kinds and lengths that change.
            self.run_in(folder, "pm-view -q --export xdin t.pmt -o t.xdin")
            self.run_in(folder, "pm-view -q --import trace t.xdin -o foreign.pmt")
            self.agrees(folder, "foreign.pmt")


if __name__ == "__main__":
    unittest.main()
