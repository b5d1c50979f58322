"""Does the reader agree with the programs on the streams that are kept, and refuse what is out of order?"""

import io
import pathlib
import unittest

import numpy as np

import pm_streams
from pm_streams.container import KINDS, Container
from pm_streams.xxh3 import xxh3_64

GOLDEN = pathlib.Path(__file__).parents[2] / "tests" / "golden"
# What the programs say of them: records, accesses (`pm-view`), digest.
STREAMS = {
    "photons.pmp": (303, None, "1b015718399db3e5f671c9519d6aee1f"),
    "tiled.pmq": (95, None, "b22812a89b49a74e44a0df4c7ec3da3c"),
    "cached.pmq": (112, None, "56a6abe0cc22af86640e485ea51aeee7"),
    "tiled.pmt": (95, 3065, "56ac14809c3609dff92f8cb580580110"),
    "windows.pmt": (53, 1643, "cb3eed7fb799cb3d75116cb46ce817d4"),
}
# Kept of version 2 only: regions that are coded together, and walks that are apart.
STREAMS_OF_VERSION_2 = {
    "apart.pmt": (95, 1351, "f492ed74e02a3fdd198bad03ff10dfd1"),
    "turns.pmt": (95, 4012, "f5025c3c9fc0437901565e0c4da10cee"),
    "waits.pmt": (95, 1381, "b9bfde3a0d09ad82728c3a1ad178ec12"),
    "walks.pmt": (4616, 142689, "fab8562fa166365121bc82b4f1295549"),
    "walks-sorted.pmt": (4616, 142689, "fab8562fa166365121bc82b4f1295549"),
}


def read(source):
    """Reads all of a stream: number of records, of accesses, digest."""
    with pm_streams.open(source) as stream:
        accesses = None
        if stream.kind == "photons":
            stream.photons()
        elif stream.kind == "queries":
            stream.queries()
        elif stream.kind == "photons of a part":
            stream.photons_of_a_part()
        else:
            accesses = sum(len(block) for block in stream.accesses())
        return stream.end.records, accesses, f"{stream.end.digest:032x}"


def pieces(data):
    """Header, blocks and end block."""
    length = lambda at: int.from_bytes(data[at : at + 4], "little")
    ends = [24 + length(12)]
    while ends[-1] < len(data):
        ends.append(ends[-1] + 40 + length(ends[-1] + 24))
    return [data[start:end] for start, end in zip([0, *ends], ends)]


class Golden(unittest.TestCase):
    def test_streams_of_every_version(self):
        for name, expected in STREAMS.items():
            for version in (1, 2):
                path = GOLDEN / f"v{version}-{name}"
                self.assertEqual(read(str(path)), expected, path)
                with pm_streams.open(str(path)) as stream:
                    self.assertEqual(stream.version, version)

    def test_streams_of_version_2(self):
        for name, expected in STREAMS_OF_VERSION_2.items():
            self.assertEqual(read(str(GOLDEN / f"v2-{name}")), expected, name)
        with pm_streams.open(str(GOLDEN / "v2-apart.pmt")) as stream:
            splits, leaves = stream.header.regions
            self.assertEqual((splits.coding, splits.leaves, leaves.coding), ("leaves apart", 51, "records"))
            for block in stream.accesses():
                # A search begins at the root, and the last it reads is a leaf, all of it.
                first = np.flatnonzero(np.diff(block.search, prepend=-1))
                self.assertEqual((block.region[first] + block.offset[first].astype(int)).max(), 0)
                last = np.append(first[1:], len(block)) - 1
                self.assertEqual(set(zip(block.region[last].tolist(), block.length[last].tolist())), {(1, 128)})

    def test_regions_that_cannot_be_coded_together(self):
        apart = (GOLDEN / "v2-apart.pmt").read_bytes()
        splits, leaves = (apart.index(name) for name in (b"splits", b"photon leaves"))
        # A tree of more leaves than there is room for; a region behind it that is coded otherwise.
        for at in (splits + 6 + 8 + 8 + 4 + 4, leaves + 13 + 8 + 8 + 4):
            header = bytearray(apart)
            header[at] += 4
            record = header[24 : 24 + int.from_bytes(header[12:16], "little")]
            header[16:24] = xxh3_64(bytes(header[:16] + record)).to_bytes(8, "little")
            with self.assertRaises(pm_streams.DamagedStream, msg=at):
                read(io.BytesIO(bytes(header)))

    def test_blocks_out_of_order(self):
        for name in STREAMS:
            whole = pieces((GOLDEN / f"v2-{name}").read_bytes())
            for at in range(1, len(whole) - 1):
                without = whole[:at] + whole[at + 1 :]
                moved = without[: len(without) - 1] + [whole[at]] + without[-1:]
                for stream in [without, *([moved] if moved != whole else [])]:
                    with self.assertRaises(pm_streams.DamagedStream, msg=f"{name}, block {at}"):
                        read(io.BytesIO(b"".join(stream)))

    def test_walks_that_are_not_what_they_say(self):
        for name, kind in (("walks", 0), ("walks-sorted", 1)):
            stream = Container(str(GOLDEN / f"v2-{name}.pmt"))
            (block,), regions = list(stream), stream.header.regions
            data = block.payload
            unpack = lambda data, length=block.walks: pm_streams.archive.unpack(data, length, block.records, regions)
            self.assertEqual(len(unpack(data)), block.walks, name)
            self.assertEqual(data[4 + int.from_bytes(data[:4], "little")], kind)
            for wrong in (data[:-4], data + b"0000", data[: len(data) // 2]):
                with self.assertRaises(pm_streams.DamagedStream, msg=name):
                    unpack(wrong)
            with self.assertRaises(pm_streams.DamagedStream, msg=name):
                unpack(data, block.walks - 1)

    def test_cut_and_flipped(self):
        data = (GOLDEN / "v2-tiled.pmt").read_bytes()
        for at in range(0, len(data), 7):
            with self.assertRaises(pm_streams.DamagedStream):
                read(io.BytesIO(data[:at]))
            flipped = data[:at] + bytes([data[at] ^ 1 << at % 8]) + data[at + 1 :]
            with self.assertRaises(pm_streams.DamagedStream, msg=at):
                read(io.BytesIO(flipped))

    def test_photons_lie_in_the_scene_and_directions_have_length_one(self):
        stream = pm_streams.open(str(GOLDEN / "v2-photons.pmp"))
        photons = stream.photons()
        low, high = stream.header.bounds
        self.assertTrue((photons["position"] >= np.array(low) - 1e-5).all())
        self.assertTrue((photons["position"] <= np.array(high) + 1e-5).all())
        normals, came_from = pm_streams.records.surface_normal(photons), pm_streams.records.came_from(photons)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)
        # A photon came from before the surface, and most surfaces of the box are along an axis.
        self.assertTrue(((normals * came_from).sum(axis=1) > -0.1).all())
        self.assertGreater((np.abs(normals).max(axis=1) > 0.999).mean(), 0.8)
        self.assertGreater(pm_streams.records.power(photons).sum(axis=1).min(), 0.0)

    def test_headers(self):
        with pm_streams.open(str(GOLDEN / "v2-windows.pmt")) as stream:
            header = stream.header
        self.assertEqual(header.meaning["sample windows"], "4")
        self.assertEqual([step["program"] for step in header.history], ["pm-queries", "pm-gather"])
        self.assertEqual((header.regions[0].coding, header.image), ("heap walk", (16, 16)))
        self.assertEqual(set(KINDS.values()), {"photons", "queries", "trace", "photons of a part"})


if __name__ == "__main__":
    unittest.main()
