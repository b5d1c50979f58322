#!/usr/bin/env python3
"""Others' traces through pm-cachesim and libCacheSim, side by side: misses must be equal, seconds are told as ratios.

    pip install libcachesim==0.3.5
    make bench-traces LIBCACHESIM=python3

Each of the two orders of a stream is written as .pmt, raw64 and oracleGeneral. Seconds are of the processor, of whole processes, medians of
interleaved rounds; the peer's own start, of Python and its library with an empty trace, is taken off. What is timed is the table, which tells
what the peer tells; the counts come from CSV, for which working sets, pages and twins are measured as well.
"""
import argparse
import csv
import io
import os
import statistics
import struct
import subprocess
import sys
import tempfile

PEER = """
import sys
import libcachesim as lcs
reader = lcs.TraceReader(sys.argv[1], lcs.TraceType.ORACLE_GENERAL_TRACE)
print("misses", round(int(sys.argv[4]) * getattr(lcs, sys.argv[2])(int(sys.argv[3])).process_trace(reader)[0]))
"""
POLICIES = {"lru": "LRU", "fifo": "FIFO", "min": "Belady"}


def options():
    parser = argparse.ArgumentParser(description="pm-cachesim and libCacheSim on the same traces.")
    parser.add_argument("traces", nargs="+", metavar="TRACE.pmt")
    parser.add_argument("--python", required=True, help="a Python that has libcachesim 0.3.5")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--cache", type=int, default=128 << 10, help="bytes, of lines of 128")
    return parser.parse_args()


def timed(command):
    """What a command prints, and its seconds of the processor."""
    before = os.times()
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    after = os.times()
    seconds = after.children_user - before.children_user + after.children_system - before.children_system
    return done.stdout, seconds


def ours(trace, cache, policy, form):
    command = ["pm-cachesim", "-q", trace, "--cache", f"{cache},full,128,{policy}"]
    return command if form == "pmt" else [*command, "--input", form]


def counts(command):
    row = next(csv.DictReader(io.StringIO(timed([*command, "--format", "csv"])[0])))
    return int(row["accesses"]), int(row["fetches"])


def peer(python, trace, cache, policy, accesses):
    text, seconds = timed([python, "-c", PEER, trace, POLICIES[policy], str(cache), str(accesses)])
    return int(text.split("misses ")[1].split()[0]), seconds


def main():
    asked = options()
    unequal = 0
    with tempfile.TemporaryDirectory() as folder:
        empty = os.path.join(folder, "one")
        with open(empty, "wb") as file:
            file.write(struct.pack("<IQIq", 0, 1, 128, -1))
        start = statistics.median(peer(asked.python, empty, asked.cache, "lru", 1)[1] for _ in range(asked.rounds))
        print(f"{'trace':<16}{'policy':<8}{'format':<16}{'accesses':>12}{'misses':>12}{'seconds':>9}{'peer':>9}{'ratio':>8}")
        for trace in asked.traces:
            name = os.path.splitext(os.path.basename(trace))[0]
            files = {"pmt": trace}
            for form in ("raw64", "oracleGeneral"):
                files[form] = os.path.join(folder, form)
                subprocess.run(["pm-view", "-q", trace, "--export", form, "--line", "128", "-o", files[form]], check=True)
            for policy in POLICIES:
                rounds = asked.rounds if policy == "lru" else 1
                commands = {form: ours(file, asked.cache, policy, form) for form, file in files.items()}
                counted = {form: counts(command) for form, command in commands.items()}
                accesses = counted["oracleGeneral"][0]
                found = {form: [] for form in files}
                theirs = []
                for _ in range(rounds):
                    for form, command in commands.items():
                        found[form].append(timed(command)[1])
                    theirs.append(peer(asked.python, files["oracleGeneral"], asked.cache, policy, accesses))
                misses, peer_seconds = theirs[0][0], max(statistics.median(each[1] for each in theirs) - start, 1e-9)
                for form, results in found.items():
                    seconds = statistics.median(results)
                    accesses, own = counted[form]
                    verdict = "" if own == misses else f"  but {misses} there"
                    unequal += own != misses
                    print(f"{name:<16}{policy:<8}{form:<16}{accesses:>12}{own:>12}{seconds:>9.2f}{peer_seconds:>9.2f}"
                          f"{peer_seconds / seconds:>8.1f}{verdict}", flush=True)
    if unequal:
        sys.exit(f"{unequal} rows have other misses than libCacheSim")


main()
