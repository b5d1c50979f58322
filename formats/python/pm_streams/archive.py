"""Walks of a trace that was kept: symbols of known frequencies (`formats/TRACE.md`, walks that are kept)."""

import struct

import numpy as np
import zstandard

from .container import DamagedStream

MOST_SEARCHES, MOST_PAYLOAD, MOST_NODES = 1 << 16, 1 << 23, 1 << 24
WAYS = 40
DECISION_CONTEXTS, COMMON, WAY_CONTEXTS = 4096, 82, 3690
MOST_TABLES = 4096 + 82 + 3690 + 2 * WAYS * (82 + 3690)


def _decisions(way):
    """The decisions that a way through seven nodes stands for."""
    if way < 8:
        return [way >> 2, way & 1, way >> 1 & 1, 0]
    way -= 8
    return [way >> 4, way >> 2 & 1, way >> 3 & 1, 1, way & 1, way >> 1 & 1]


DECISIONS = [_decisions(way) for way in range(WAYS)]


def _frame(data, at, most):
    """The content of a zstd frame behind its length, and the place behind it."""
    end = at + 4 + (struct.unpack_from("<I", data, at)[0] if at + 4 <= len(data) else len(data))
    if end > len(data):
        raise DamagedStream("a block of walks ends too early")
    try:
        content = zstandard.ZstdDecompressor().decompress(data[at + 4 : end], max_output_size=most)
    except zstandard.ZstdError as error:
        raise DamagedStream(f"a block cannot be decompressed: {error}") from None
    if len(content) > most:
        raise DamagedStream("a block of walks holds more than it may")
    return content, end


def _integer(data, at):
    """A LEB128 integer, and the place behind it."""
    value, shift = 0, 0
    while at < len(data) and shift < 63:
        value |= (data[at] & 127) << shift
        at, shift = at + 1, shift + 7
        if data[at - 1] < 128:
            return value, at
    raise DamagedStream("an integer has no end")


def _trees(heads, searches, regions):
    """How often each search walks, and the nodes of the one tree that is walked."""
    at, counts, tree = 0, [], None
    for _ in range(searches):
        segments, at = _integer(heads, at)
        counts.append(0)
        for _ in range(segments):
            head, at = _integer(heads, at)
            if head >> 1 >= len(regions):
                raise DamagedStream("a search reads a region that is not there")
            coding = regions[head >> 1].coding
            if head & 1 and coding in ("heap walk", "leaves apart"):
                if tree not in (None, head >> 1):
                    raise DamagedStream("a block of walks walks two trees")
                tree = head >> 1
                counts[-1] += 1
            elif coding == "addresses" or head & 1 and coding == "records":
                raise DamagedStream("a search reads a region that is not there")
            else:
                _, at = _integer(heads, at)
    if tree is None or not 1 <= regions[tree].nodes <= MOST_NODES:
        raise DamagedStream("a block of walks has none, or too large a tree")
    return counts, regions[tree].nodes


def _tables(data):
    """Sizes of the shares of ones, and for each context of a way the starts of the ways' shares."""
    flags = np.frombuffer(data[DECISION_CONTEXTS : DECISION_CONTEXTS + COMMON + WAY_CONTEXTS], np.uint8)
    at = DECISION_CONTEXTS + COMMON + WAY_CONTEXTS
    if len(flags) < COMMON + WAY_CONTEXTS or flags.max() > 1:
        raise DamagedStream("a block of walks has no tables")
    only, tables = [0] + [4096] * WAYS, {}
    for context in np.flatnonzero(flags).tolist():
        starts = [0]
        for _ in range(WAYS):
            size, at = _integer(data, at)
            starts.append(starts[-1] + size)
        if starts[-1] != 4096:
            raise DamagedStream("shares do not add up to the whole")
        tables[context] = starts
    if at != len(data):
        raise DamagedStream("bytes follow the tables")
    common = lambda context: tables.get(context // 90 * 2 + context % 2, only)
    ways = [tables.get(COMMON + context) or common(context) for context in range(WAY_CONTEXTS)]
    return [16 * ones + 8 for ones in data[:DECISION_CONTEXTS]], ways


class _Symbols:
    """Symbols by two states that take turns."""

    def __init__(self, data):
        if len(data) < 16 or len(data) % 4:
            raise DamagedStream("a block of walks ends too early")
        self.state, self.other = struct.unpack_from("<2Q", data)
        self.words = iter(np.frombuffer(data[16:], "<u4").tolist())

    def take(self, start, size):
        state = size * (self.state >> 12) + (self.state & 4095) - start
        if state < 1 << 32:
            state = state << 32 | next(self.words, 0)
        self.state, self.other = self.other, state

    def decision(self, ones):
        if self.state & 4095 < ones:
            self.take(0, ones)
            return 1
        self.take(ones, 4096 - ones)
        return 0

    def way(self, starts):
        number = self.state & 4095
        low, high = 0, WAYS
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if starts[middle] <= number else (low, middle)
        self.take(starts[low], starts[low + 1] - starts[low])
        return low

    def done(self):
        return self.state == self.other == 1 << 32 and next(self.words, None) is None


class _Memory:
    """What walks so far did, and how the next one is told by it."""

    def __init__(self, nodes, ones, ways):
        self.nodes, self.ones, self.ways = nodes, ones, ways
        self.before, self.last = [{}, {}], {}

    def walk(self, symbols, bits):
        """The bits of one walk."""
        nodes, beside = self.nodes, [[0] * 32, [0] * 32]

        def decide(node, entered, sort):
            kind, depth = int(sort >= 2), node.bit_length() - 1
            before, near = self.before[kind].get(node, 0), beside[kind][depth]
            bit = symbols.decision(self.ones[1024 * before + 256 * near + 32 * entered + 4 * (node & 7) + sort])
            self.before[kind][node] = (before << 1 | bit) & 3
            beside[kind][depth] = (near << 1 | bit) & 3
            bits.append(bit)
            return bit

        waiting, node, entered = [], 1, 0
        while True:
            if 8 * node > nodes and 4 * node + 3 <= nodes:
                near = self.last.get(node ^ 1, WAYS) if entered & 1 else WAYS + 1 + (entered >> 1)
                way = symbols.way(self.ways[(self.last.get(node, WAYS) * 45 + near) * 2 + node % 2])
                self.last[node] = way
                bits.extend(DECISIONS[way])
            elif 2 * node < nodes:
                first = decide(node, entered, 0)
                waiting.append((node, first, entered))
                node, entered = 2 * node + first, entered << 1 & 7
                continue
            elif 2 * node == nodes and decide(node, entered, 1):
                node, entered = 2 * node, entered << 1 & 7
                continue
            while waiting:
                parent, first, above = waiting.pop()
                if decide(parent, above, 2 + first):
                    node, entered = 2 * parent + 1 - first, above << 1 & 7 | 1
                    break
            else:
                return


def unpack(data, length, searches, regions):
    """The payload of so many bytes that was packed so."""
    if length > MOST_PAYLOAD or searches > MOST_SEARCHES:
        raise DamagedStream("a block of walks is larger than any may be")
    rest, at = _frame(data, 0, length)
    heads, destinations, none = struct.unpack_from("<3I", rest) if len(rest) >= 12 else (0, 0, 1)
    if none or 12 + heads + destinations > len(rest):
        raise DamagedStream("a block does not hold its searches")
    counts, nodes = _trees(rest[12 : 12 + heads], searches, regions)
    kind, at = data[at] if at < len(data) else 255, at + 1
    order = range(searches)
    if kind == 1:
        order = np.frombuffer(data[at : at + 2 * searches], "<u2").tolist()
        at += 2 * searches
    if kind > 1 or sorted(order) != list(range(searches)):
        raise DamagedStream("a block of walks has no order")
    tables, at = _frame(data, at, MOST_TABLES)
    symbols, memory = _Symbols(data[at:]), _Memory(nodes, *_tables(tables))
    walks, most = [b""] * searches, length - len(rest)
    for search in order:
        bits = []
        for _ in range(counts[search]):
            memory.walk(symbols, bits)
        walks[search] = np.packbits(np.array(bits, np.uint8), bitorder="little").tobytes()
        most -= len(walks[search])
        if most < 0:
            raise DamagedStream("walks are longer than the block says")
    if most or not symbols.done():
        raise DamagedStream("a block of walks holds more than they are")
    plane = b"".join(walks)
    lengths = struct.pack("<3I", heads, destinations, len(plane))
    begin = 12 + heads + destinations
    return lengths + rest[12:begin] + plane + rest[begin:]
