"""Reads the streams of the pm programs: photons, queries and traces, as NumPy arrays.

    import pm_streams
    stream = pm_streams.open("map.pmp")
    print(stream.header.bounds, len(stream.photons()))
    for accesses in pm_streams.open("trace.pmt").accesses():
        ...

Written from `formats/README.md` alone. Every checksum, count, digest and proof of order is verified: what is returned to the end is
whole, and what is not raises `DamagedStream`.
"""

import struct

import numpy as np

from . import records, trace
from .container import IRRADIANCE_RECORDS, RECORDS, Block, Container, DamagedStream, End, Header, Region
from .trace import Accesses
from .xxh3 import sum_of_records, xxh3_128

__all__ = ["open", "Stream", "Accesses", "Block", "DamagedStream", "End", "Header", "Region", "records"]


class Stream:
    """A stream: what it is about at once, its records when asked for, once."""

    def __init__(self, source):
        self._blocks = Container(source)
        self.kind, self.version, self.header = self._blocks.kind, self._blocks.version, self._blocks.header

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._blocks.close()

    @property
    def end(self):
        """The end block, once all records were read."""
        return self._blocks.end

    def photons(self):
        """All photons, as an array of `records.PHOTON`."""
        return self._all("photons", records.PHOTON)

    def photons_of_a_part(self):
        """All photons of a part, their powers not yet rounded, as an array of `records.PHOTON_OF_A_PART`."""
        return self._all("photons of a part", records.PHOTON_OF_A_PART)

    def queries(self):
        """All queries, as an array of `records.QUERY`."""
        return self._all("queries", records.QUERY)

    def accesses(self):
        """The accesses of a trace, block by block."""
        self._expect("trace")
        found, digest = 0, 0
        for block in self._blocks:
            accesses, more = trace.decode(block, self.header.regions)
            found, digest = found + block.records, digest + more
            yield accesses
        self._check(found, digest)

    def _expect(self, kind):
        if self.kind != kind:
            raise TypeError(f"the stream holds {self.kind}, not {kind}")

    def _all(self, kind, dtype):
        self._expect(kind)
        parts, digest = [np.zeros(0, dtype)], 0
        for block in self._blocks:
            if block.section == RECORDS:
                if len(block.payload) != block.records * dtype.itemsize:
                    raise DamagedStream("a block does not hold its records")
                rows = records.unpacked(block.payload, block.records, dtype.itemsize // 4)
                digest += sum_of_records(rows)
                parts.append(rows.view(dtype)[:, 0])
            else:
                digest += _beside(block)
        whole = np.concatenate(parts)
        self._check(len(whole), digest)
        return whole

    def _check(self, found, digest):
        if self.end.records != found:
            raise DamagedStream("the end block speaks of another number of records")
        if self.end.digest != digest % (1 << 128):
            raise DamagedStream("the records do not fit the digest in the end block")


def _beside(block):
    """What a table beside the queries adds to the digest: its rows, each seeded with the number of its section."""
    words = len(block.payload) // 4
    if block.records > words or (words and (not block.records or words % block.records)):
        raise DamagedStream("a table beside the queries does not hold its rows")
    if not words:
        return 0
    rows = records.unpacked(block.payload, block.records, words // block.records)
    if block.section == IRRADIANCE_RECORDS:
        for row in rows:
            elevation, azimuth = struct.unpack_from("<2I", row, 32)
            if len(row) != 4 * (10 + 4 * elevation * azimuth):
                raise DamagedStream("an irradiance record has another number of rays than it says")
    return sum(xxh3_128(row.tobytes(), block.section) for row in rows)


def open(source):
    """Opens a stream: the name of a file, or a binary file that is open."""
    return Stream(source)
