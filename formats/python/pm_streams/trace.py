"""Traces: the accesses of searches, by `formats/README.md`."""

import struct
from dataclasses import dataclass

import numpy as np

from .archive import unpack
from .container import DamagedStream
from .xxh3 import xxh3_128

READ, WRITE, READ_MODIFY_WRITE = 0, 1, 2


@dataclass
class Accesses:
    """The accesses of a block, in order: arrays of one length, but for `pixels`, which has a list for each search."""

    batch: int
    warm_up: bool
    search: np.ndarray  #: number of the search within the block
    region: np.ndarray
    kind: np.ndarray  #: READ, WRITE or READ_MODIFY_WRITE
    offset: np.ndarray  #: bytes from the region's base
    length: np.ndarray  #: bytes
    pixels: list  #: those that each search serves

    def __len__(self):
        return len(self.offset)


class _Integers:
    """A plane of LEB128 integers: all of them, and where each begins."""

    def __init__(self, plane):
        data = np.frombuffer(plane, np.uint8)
        ends = np.flatnonzero(data < 128)
        if len(data) and (not len(ends) or ends[-1] != len(data) - 1):
            raise DamagedStream("an integer has no end")
        starts = np.concatenate([[0], ends[:-1] + 1]).astype(np.int64) if len(ends) else np.zeros(0, np.int64)
        widths = ends - starts + 1
        if len(widths) and widths.max() > 10:
            raise DamagedStream("an integer is too long")
        values = np.zeros(len(ends), np.uint64)
        for place in range(int(widths.max()) if len(widths) else 0):
            there = widths > place
            values[there] |= (data[starts[there] + place] & np.uint8(127)).astype(np.uint64) << np.uint64(7 * place)
        self.plane, self.values, self.starts = plane, values.tolist(), [*starts.tolist(), len(plane)]
        self.at = 0

    def take(self):
        if self.at == len(self.values):
            raise DamagedStream("a plane of a block ends before its searches do")
        self.at += 1
        return self.values[self.at - 1]

    def bytes_since(self, at):
        return self.plane[self.starts[at] : self.starts[self.at]]


def _unzigzag(z):
    return z >> 1 ^ -(z & 1)


def _walk(bits, at, nodes, reread, reads):
    """Reads of one depth-first walk, as indices of records; the place in the bits behind it."""
    waiting, node = [], 1
    while True:
        reads.append(node - 1)
        left = 2 * node
        if left < nodes:
            second = bits[at]
            at += 1
            waiting.append((node, left + 1 - second))
            node = left + second
            continue
        if left == nodes:
            at += 1
            if bits[at - 1]:
                waiting.append((node, 0))
                node = left
                continue
            if reread:
                reads.append(node - 1)
        while waiting:
            parent, other = waiting.pop()
            if other:
                at += 1
                if bits[at - 1]:
                    waiting.append((parent, 0))
                    node = other
                    break
            if reread:
                reads.append(parent - 1)
        else:
            return at


def _leaves_apart(nodes, region, number, below):
    """Numbers of the regions, offsets and lengths of reads of nodes, the first of which is 0."""
    leaf = nodes >= region.leaves - 1
    lengths = np.where(leaf, below.record_size, region.record_size).astype(np.uint32)
    offsets = np.where(leaf, nodes - (region.leaves - 1), nodes) * lengths
    return (number + leaf).astype(np.uint16), offsets, lengths


def _others(plane, count, region, last):
    """Accesses that are spelled out: kinds, offsets, lengths, and the last value."""
    kinds, offsets, lengths = [], [], []
    for _ in range(count):
        token = plane.take()
        if token & 1:
            kind, last = token >> 1, last + _unzigzag(plane.take())
            offset, length = last, plane.take()
        else:
            kind, last = READ, last + _unzigzag(token >> 1)
            offset, length = last * region.record_size, region.record_size
        if kind > READ_MODIFY_WRITE or offset < 0 or offset + length > region.size:
            raise DamagedStream("an access lies outside its region")
        kinds.append(kind)
        offsets.append(offset)
        lengths.append(length)
    return kinds, offsets, lengths, last


def _in_turns(plane, count, regions, last, levels):
    """Reads of whole records in turns of these regions, (number, region) each: numbers of their regions, offsets, lengths.

    What each waits for, where it says so, is checked and no more; `levels` has the number of levels read so far."""
    bits = (len(regions) - 1).bit_length()
    numbers, offsets, lengths = [], [], []
    for _ in range(count):
        if regions and regions[0][1].waits:
            waits = plane.take()
            if waits >= 1 << 16 or waits >> 1 > levels[0]:
                raise DamagedStream("a read waits for a level that has none")
            levels[0] = max(levels[0], (waits >> 1) + 1)
        token = plane.take()
        rank = token & (1 << bits) - 1
        if rank >= len(regions):
            raise DamagedStream("a search reads a region that is not there")
        last[rank] += _unzigzag(token >> bits)
        number, region = regions[rank]
        if not 0 <= last[rank] < region.size // region.record_size:
            raise DamagedStream("an access lies outside its region")
        numbers.append(number)
        offsets.append(last[rank] * region.record_size)
        lengths.append(region.record_size)
    return np.array(numbers, np.uint16), offsets, np.array(lengths, np.uint32)


def decode(block, regions):
    """The accesses of a block, and what its searches add to the digest."""
    payload = block.payload if block.walks is None else unpack(block.payload, block.walks, block.records, regions)
    if len(payload) < 12:
        raise DamagedStream("a block does not hold its searches")
    ends = np.cumsum([12, *struct.unpack_from("<3I", payload)]).tolist()
    if ends[3] > len(payload):
        raise DamagedStream("a block does not hold its searches")
    heads, destinations = (_Integers(payload[ends[i] : ends[i + 1]]) for i in (0, 1))
    walks, spelled = payload[ends[2] : ends[3]], payload[ends[3] :]
    # Where the region is all addresses the last plane has eight bytes for each access, and no integers of any length.
    of_addresses = any(region.coding == "addresses" for region in regions)
    in_turns = [(number, region) for number, region in enumerate(regions) if region.coding == "in turns"]
    others, address = _Integers(b"" if of_addresses else spelled), 0
    bits, walked = np.unpackbits(np.frombuffer(walks, np.uint8), bitorder="little").tolist(), 0
    parts, per_search, pixels, digest, pixel = [], [], [], 0, 0
    for _ in range(block.records):
        before = heads.at, walked, others.at, address
        served = []
        for _ in range(destinations.take()):
            pixel += _unzigzag(destinations.take())
            served.append(pixel)
        pixels.append(served)
        last, at, count, last_in_turns, levels = 0, 8 * walked, 0, [0] * len(in_turns), [0]
        for _ in range(heads.take()):
            head = heads.take()
            number, region = head >> 1, regions[head >> 1] if head >> 1 < len(regions) else None
            if region is None or (head & 1) != (1 if of_addresses else head & (region.coding != "records")):
                raise DamagedStream("a search reads a region that is not there")
            if of_addresses:
                accesses, kinds, lengths = heads.take(), heads.take(), heads.take()
                end = address + 8 * accesses
                if kinds > READ_MODIFY_WRITE or lengths >= 1 << 32 or end > len(spelled):
                    raise DamagedStream("an access lies outside its region")
                offsets, address = np.frombuffer(spelled[address:end], "<u8"), end
                if len(offsets) and int(offsets.max()) + max(lengths, 1) > 1 << 64:
                    raise DamagedStream("an access lies outside its region")
            elif head & 1 and region.coding == "in turns":
                number, offsets, lengths = _in_turns(others, heads.take(), in_turns, last_in_turns, levels)
                kinds = READ
            elif head & 1:
                reads = []
                try:
                    at = _walk(bits, at, region.nodes, region.reread, reads)
                except IndexError:
                    raise DamagedStream("a walk ends before its tree does") from None
                offsets = np.array(reads, np.uint64) * np.uint64(region.record_size)
                kinds, lengths = READ, region.record_size
                if region.coding == "leaves apart":
                    number, offsets, lengths = _leaves_apart(np.array(reads, np.int64), region, number, regions[number + 1])
            else:
                kinds, offsets, lengths, last = _others(others, heads.take(), region, last)
            parts.append((number, kinds, np.array(offsets, np.uint64), lengths))
            count += len(offsets)
        per_search.append(count)
        walked = (at + 7) // 8
        search = struct.pack(f"<Q{len(served)}I", len(served), *served)
        search += heads.bytes_since(before[0]) + walks[before[1] : walked]
        search += spelled[before[3] : address] if of_addresses else others.bytes_since(before[2])
        digest += xxh3_128(search)
    if (heads.at, destinations.at, walked, others.at, address) != (
        len(heads.values),
        len(destinations.values),
        len(walks),
        len(others.values),
        len(spelled) if of_addresses else 0,
    ):
        raise DamagedStream("a block holds more than its searches")
    whole = lambda of, dtype: np.concatenate([np.zeros(0, dtype), *(np.full(len(part[2]), of(part), dtype) for part in parts)])
    accesses = Accesses(
        block.batch,
        block.warm_up,
        np.repeat(np.arange(block.records), per_search),
        whole(lambda part: part[0], np.uint16),
        whole(lambda part: part[1], np.uint8),
        np.concatenate([np.zeros(0, np.uint64), *(part[2] for part in parts)]),
        whole(lambda part: part[3], np.uint32),
        pixels,
    )
    return accesses, digest
