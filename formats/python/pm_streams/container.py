"""The container of all streams: header, blocks, end block (`formats/README.md`)."""

import io
import struct
from dataclasses import dataclass, field

import zstandard

from .xxh3 import xxh3_64

MAGIC = b"\x89PMS\r\n\x1a\n"
KINDS = {1: "photons", 2: "queries", 3: "trace", 4: "photons of a part"}
RECORDS, IRRADIANCE_RECORDS, PIXEL_WEIGHTS, END = 0, 1, 2, 255
MOST_BYTES, MOST_PIXELS, DEEPEST = 1 << 26, 1 << 28, 64


class DamagedStream(Exception):
    """The stream contradicts itself, or stops before its end block."""


@dataclass
class Region:
    """A part of the traced memory.

    `coding` is "records", "heap walk" with its number of nodes, "addresses" (all of 64 bits), "leaves apart" with the number of
    nodes of the whole tree, or "in turns", of which `waits` tells whether each read says what it waits for.
    """

    name: str
    base: int
    size: int
    record_size: int
    coding: str
    nodes: int = 0
    leaves: int = 0
    reread: bool = False
    waits: bool = False


@dataclass
class Header:
    """What a stream is about; `meaning` and `history` are as the programs wrote them."""

    bounds: tuple
    image: tuple
    materials: list
    expected_records: int | None
    meaning: dict
    regions: list
    history: list


@dataclass
class Block:
    """A run of records of one batch, decompressed; of a trace's walks that are kept, as they stand and for so many bytes."""

    section: int
    batch: int
    warm_up: bool
    records: int
    payload: bytes = field(repr=False)
    walks: int | None = None


@dataclass
class End:
    """Number and digest of all records, and what each stage measured: (program, {name: number})."""

    records: int
    digest: int
    stages: list


class _Fields:
    """Bincode with fixed-size little-endian integers."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, layout):
        layout = "<" + layout
        try:
            values = struct.unpack_from(layout, self.data, self.at)
        except struct.error:
            raise DamagedStream("a record ends before its fields do") from None
        self.at += struct.calcsize(layout)
        return values[0] if len(values) == 1 else values

    def text(self):
        length = self.take("Q")
        if length > len(self.data) - self.at:
            raise DamagedStream("a text is longer than what holds it")
        self.at += length
        return self.data[self.at - length : self.at].decode("utf-8")

    def option(self, read):
        given = self.take("B")
        if given > 1:
            raise DamagedStream("an option is neither given nor left out")
        return read() if given else None

    def list(self, read):
        count = self.take("Q")
        if count > len(self.data) - self.at:
            raise DamagedStream("a list is longer than what holds it")
        return [read() for _ in range(count)]

    def done(self, value):
        if self.at != len(self.data):
            raise DamagedStream("bytes follow the last field")
        return value


def _step(fields, depth=0):
    if depth > DEEPEST:
        raise DamagedStream("a history is nested too deeply")
    nested = lambda: (fields.text(), fields.list(lambda: _step(fields, depth + 1)))
    return {
        "program": fields.text(),
        "version": fields.text(),
        "arguments": fields.list(fields.text),
        "seed": fields.option(lambda: fields.take("Q")),
        "input": fields.option(fields.text),
        "inputs": fields.list(nested),
    }


def _region(fields):
    region = Region(fields.text(), *fields.take("QQI"), coding="records")
    number = fields.take("I")
    if number == 1:
        region.coding = "heap walk"
        region.nodes, region.reread = fields.take("I?")
    elif number == 2:
        region.coding = "addresses"
    elif number == 3:
        leaves = fields.take("I")
        region.coding, region.leaves, region.nodes = "leaves apart", leaves, max(2 * leaves - 1, 0)
    elif number == 4:
        region.coding = "in turns"
    elif number == 5:
        region.coding, region.waits = "in turns", True
    elif number != 0:
        raise DamagedStream(f"region {region.name!r} has coding {number}, which is not known")
    return region


def _check_together(regions):
    """Regions that are coded together must have what it takes."""
    in_turns = [region for region in regions if region.coding == "in turns"]
    if len(in_turns) > 64 or not all(region.record_size for region in in_turns):
        raise DamagedStream("regions cannot be coded in turns")
    if len({region.waits for region in in_turns}) > 1:
        raise DamagedStream("of the regions that are coded in turns some say what reads wait for and some do not")
    for tree, below in zip(regions, [*regions[1:], None]):
        if tree.coding != "leaves apart":
            continue
        if below is None or below.coding != "records" or tree.leaves >= 1 << 30 or not tree.record_size or not below.record_size:
            raise DamagedStream("a tree has no region of leaves behind it")
        inner = max(tree.leaves - 1, 0)
        if inner * tree.record_size > tree.size or tree.leaves * below.record_size > below.size:
            raise DamagedStream("a region is smaller than its nodes")


def _header(data):
    fields = _Fields(data)
    bounds = fields.take("3f"), fields.take("3f")
    image = fields.take("2I")
    if image[0] * image[1] > MOST_PIXELS:
        raise DamagedStream("the image has more than 2^28 pixels")
    material = lambda: {
        "name": fields.text(),
        "diffuse": fields.take("3f"),
        "specular": fields.take("3f"),
        "exponent": fields.take("f"),
    }
    materials = fields.list(material)
    expected = fields.option(lambda: fields.take("Q"))
    meaning = dict(fields.list(lambda: (fields.text(), fields.text())))
    regions = fields.list(lambda: _region(fields))
    _check_together(regions)
    history = fields.list(lambda: _step(fields))
    return fields.done(Header(bounds, image, materials, expected, meaning, regions, history))


def _end(data, proves_order):
    fields = _Fields(data)
    records, low, high = fields.take("QQQ")
    number = lambda: fields.take({0: "Q", 1: "Q", 2: "d"}[fields.take("I")])
    stages = fields.list(lambda: (fields.text(), dict(fields.list(lambda: (fields.text(), number())))))
    proof = fields.take("Q") if proves_order else None
    return fields.done((End(records, high << 64 | low, stages), proof))


class Container:
    """A stream, read block by block: iterate over it, then ask for `end`."""

    def __init__(self, source):
        self.is_ours = not isinstance(source, io.IOBase)
        self.file = open(source, "rb") if self.is_ours else source
        self.end = None
        prelude = self._take(24, "the stream stops in its header")
        if prelude[:8] != MAGIC:
            raise DamagedStream("this is not a pm stream: it does not begin with its signature")
        self.version, kind, length = struct.unpack("<HHI", prelude[8:16])
        if self.version not in (1, 2):
            raise DamagedStream(f"format version {self.version} is not known")
        if length > MOST_BYTES or kind not in KINDS:
            raise DamagedStream("the header makes no sense")
        record = self._take(length, "the stream stops in its header")
        if struct.unpack("<Q", prelude[16:])[0] != xxh3_64(prelude[:16] + record):
            raise DamagedStream("the header does not fit its checksum")
        self.kind, self.header = KINDS[kind], _header(record)
        self._proof = [prelude]

    def close(self):
        """Closes the file, if it was opened here."""
        if self.is_ours:
            self.file.close()

    def _take(self, count, otherwise):
        data = self.file.read(count)
        if len(data) < count:
            raise DamagedStream(otherwise)
        return data

    def __iter__(self):
        windows, last = "sample windows" in self.header.meaning, None
        while True:
            head = self._take(40, "the stream stops before its end block")
            tag, section, flags, packed, zero, batch, records, raw, stored = struct.unpack_from("<4s4BQ3I", head)
            if tag != b"PMBL" or head[28:32] != struct.pack("<Q", xxh3_64(head[:28]))[:4]:
                raise DamagedStream("a block's header does not fit its checksum")
            if section not in (RECORDS, IRRADIANCE_RECORDS, PIXEL_WEIGHTS, END) or flags > 1 or packed > 2 or zero:
                raise DamagedStream("a block's header makes no sense")
            if max(raw, stored) > MOST_BYTES:
                raise DamagedStream("a block is larger than any may be")
            payload = self._take(stored, "the stream stops before its end block")
            if struct.unpack_from("<Q", head, 32)[0] != xxh3_64(payload):
                raise DamagedStream("a block does not fit its checksum")
            if packed == 1:
                try:
                    payload = zstandard.ZstdDecompressor().decompress(payload, max_output_size=raw)
                except zstandard.ZstdError as error:
                    raise DamagedStream(f"a block cannot be decompressed: {error}") from None
            if packed == 2 and (self.kind != "trace" or section != RECORDS):
                raise DamagedStream("a block that is none of a trace holds walks")
            if packed < 2 and len(payload) != raw:
                raise DamagedStream("a block has another length than it says")
            if section == END:
                self.end, proof = _end(payload, self.version >= 2)
                if proof is not None and proof != xxh3_64(b"".join(self._proof)):
                    raise DamagedStream("the end block speaks of other blocks, or of these in another order")
                if self.file.read(1):
                    raise DamagedStream("bytes follow the end block")
                self.close()
                return
            place = (batch, not flags & 1)
            if section != RECORDS and last is not None:
                raise DamagedStream("cached irradiance stands behind the first queries")
            if section == RECORDS:
                if windows and last is not None and place < last:
                    raise DamagedStream("its windows are out of order")
                last = place
            self._proof.append(head)
            yield Block(section, batch, bool(flags & 1), records, payload, raw if packed == 2 else None)
