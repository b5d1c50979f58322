#!/usr/bin/env python3
"""Streams of photons or queries as raw numbers: export.py STREAM OUTPUT.

Of photons the records as they are, 20 bytes each; of queries x, y, z as 32-bit floats. Read by formats/README.md, with numpy and
one of the packages zstandard and pyarrow. Exit codes: 0 done, 1 failed, 2 asked wrongly, 3 the stream is incomplete or damaged.
"""

import struct
import sys

import numpy as np

SIGNATURE = b"\x89PMS\r\n\x1a\n"
# Words of a record, and those of them that are written, by the kind of the stream.
WORDS = {1: (5, 5), 2: (11, 3)}


def decompressor():
    """A function from a zstd frame and the size of what it holds to that."""
    try:
        import zstandard

        return lambda frame, size: zstandard.ZstdDecompressor().decompress(frame, max_output_size=size)
    except ImportError:
        import pyarrow

        codec = pyarrow.Codec("zstd")
        return lambda frame, size: codec.decompress(frame, decompressed_size=size, asbytes=True)


def damaged(path, what):
    print(f"export.py: {path}: {what}; make the stream again", file=sys.stderr)
    sys.exit(3)


def blocks(path, stream):
    """Kind of the stream, and payload and number of records of each of its blocks."""
    inflate = decompressor()
    head = stream.read(24)
    if len(head) < 24 or head[:8] != SIGNATURE:
        damaged(path, "not a stream of pm")
    version, kind, length = struct.unpack("<HHI", head[8:16])
    if version != 1 or kind not in WORDS:
        damaged(path, f"version {version}, kind {kind}: neither photons nor queries of version 1")
    stream.seek(length, 1)
    while True:
        head = stream.read(40)
        if len(head) < 40 or head[:4] != b"PMBL":
            damaged(path, "it ends before its end block")
        section, _, packed, _, _, records, size, stored = struct.unpack("<BBBBQIII", head[4:28])
        payload = stream.read(stored)
        if len(payload) < stored:
            damaged(path, "it ends within a block")
        if section == 255:
            payload = inflate(payload, size) if packed else payload
            yield kind, None, struct.unpack("<Q", payload[:8])[0]
            return
        if section == 0:
            yield kind, inflate(payload, size) if packed else payload, records


def main():
    if len(sys.argv) != 3:
        print("export.py: asked wrongly: export.py STREAM OUTPUT", file=sys.stderr)
        sys.exit(2)
    path, output = sys.argv[1:]
    written = 0
    try:
        with open(path, "rb") as stream, open(output, "wb") as file:
            for kind, payload, records in blocks(path, stream):
                if payload is None:
                    if written != records:
                        damaged(path, f"{written} records where its end block says {records}")
                    break
                words, kept = WORDS[kind]
                # The first words of all records, then all second words, and so on.
                columns = np.frombuffer(payload, dtype="<u4").reshape(words, records)
                file.write(np.ascontiguousarray(columns[:kept].T).tobytes())
                written += records
    except OSError as error:
        print(f"export.py: {error}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main()
