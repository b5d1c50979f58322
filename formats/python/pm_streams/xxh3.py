"""XXH3 of 64 and 128 bits, as its specification has it (Cyan4973/xxHash, doc/xxhash_spec.md).

`xxh3_64` and `xxh3_128` hash bytes one by one; `sum_of_records` hashes all rows of an array at once.
"""

import struct

import numpy as np

_SECRET = bytes.fromhex(
    "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221"
    "b8084674f743248ee03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8"
    "a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb"
    "170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e"
)
_P32 = (0x9E3779B1, 0x85EBCA77, 0xC2B2AE3D)
_P64 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5)
_MX1, _MX2 = 0x165667919E3779F9, 0x9FB21C651E98DF25
_64 = (1 << 64) - 1


def _r32(data, at):
    return struct.unpack_from("<I", data, at)[0]


def _r64(data, at):
    return struct.unpack_from("<Q", data, at)[0]


def _swap64(x):
    return int.from_bytes(x.to_bytes(8, "little"), "big")


def _rotl(x, n):
    return (x << n | x >> (64 - n)) & _64


def _fold(a, b):
    product = a * b
    return (product & _64) ^ (product >> 64)


def _avalanche(h):
    h ^= h >> 37
    h = h * _MX1 & _64
    return h ^ h >> 32


def _avalanche_of_xxh64(h):
    h ^= h >> 33
    h = h * _P64[1] & _64
    h ^= h >> 29
    h = h * _P64[2] & _64
    return h ^ h >> 32


def _mix16(data, at, secret, s, seed):
    return _fold(_r64(data, at) ^ (_r64(secret, s) + seed & _64), _r64(data, at + 8) ^ (_r64(secret, s + 8) - seed & _64))


def _mix32(acc, data, one, other, s, seed):
    acc[0] = (acc[0] + _mix16(data, one, _SECRET, s, seed) & _64) ^ (_r64(data, other) + _r64(data, other + 8) & _64)
    acc[1] = (acc[1] + _mix16(data, other, _SECRET, s + 16, seed) & _64) ^ (_r64(data, one) + _r64(data, one + 8) & _64)


def _pairs_from_the_ends(length):
    """Of 17 to 128 bytes: how far from each end, and where in the secret, outermost last."""
    return reversed([(16 * i, 32 * i) for i in range((length + 31) // 32)])


def _long(data, seed):
    """The eight accumulators of more than 240 bytes, and their secret."""
    secret = _SECRET
    if seed:
        halves = [(_r64(secret, at) + (seed if at % 16 == 0 else -seed)) & _64 for at in range(0, 192, 8)]
        secret = struct.pack("<24Q", *halves)
    acc = [_P32[2], _P64[0], _P64[1], _P64[2], _P64[3], _P32[1], _P64[4], _P32[0]]

    def accumulate(at, s):
        for i in range(8):
            value = _r64(data, at + 8 * i)
            key = value ^ _r64(secret, s + 8 * i)
            acc[i ^ 1] = acc[i ^ 1] + value & _64
            acc[i] = acc[i] + (key & 0xFFFFFFFF) * (key >> 32) & _64

    blocks = (len(data) - 1) // 1024
    for block in range(blocks):
        for stripe in range(16):
            accumulate(1024 * block + 64 * stripe, 8 * stripe)
        for i in range(8):
            acc[i] = ((acc[i] ^ acc[i] >> 47) ^ _r64(secret, 128 + 8 * i)) * _P32[0] & _64
    for stripe in range((len(data) - 1 - 1024 * blocks) // 64):
        accumulate(1024 * blocks + 64 * stripe, 8 * stripe)
    accumulate(len(data) - 64, 192 - 64 - 7)
    return acc, secret


def _merge(acc, secret, s, start):
    total = start
    for i in range(4):
        total += _fold(acc[2 * i] ^ _r64(secret, s + 16 * i), acc[2 * i + 1] ^ _r64(secret, s + 16 * i + 8))
    return _avalanche(total & _64)


def xxh3_64(data):
    """The hash of bytes, without a seed."""
    n = len(data)
    if n == 0:
        return _avalanche_of_xxh64(_r64(_SECRET, 56) ^ _r64(_SECRET, 64))
    if n <= 3:
        combined = data[n // 2] << 24 | data[0] << 16 | data[-1] | n << 8
        return _avalanche_of_xxh64(combined ^ _r32(_SECRET, 0) ^ _r32(_SECRET, 4))
    if n <= 8:
        h = (_r32(data, n - 4) + (_r32(data, 0) << 32)) ^ _r64(_SECRET, 8) ^ _r64(_SECRET, 16)
        h ^= _rotl(h, 49) ^ _rotl(h, 24)
        h = h * _MX2 & _64
        h ^= (h >> 35) + n
        h = h * _MX2 & _64
        return h ^ h >> 28
    if n <= 16:
        low = _r64(data, 0) ^ _r64(_SECRET, 24) ^ _r64(_SECRET, 32)
        high = _r64(data, n - 8) ^ _r64(_SECRET, 40) ^ _r64(_SECRET, 48)
        return _avalanche(n + _swap64(low) + high + _fold(low, high) & _64)
    if n <= 128:
        acc = n * _P64[0]
        for at, s in _pairs_from_the_ends(n):
            acc += _mix16(data, at, _SECRET, s, 0) + _mix16(data, n - 16 - at, _SECRET, s + 16, 0)
        return _avalanche(acc & _64)
    if n <= 240:
        acc = n * _P64[0] + sum(_mix16(data, 16 * i, _SECRET, 16 * i, 0) for i in range(8))
        end = _mix16(data, n - 16, _SECRET, 136 - 17, 0)
        end += sum(_mix16(data, 16 * i, _SECRET, 16 * (i - 8) + 3, 0) for i in range(8, n // 16))
        return _avalanche(_avalanche(acc & _64) + end & _64)
    acc, secret = _long(data, 0)
    return _merge(acc, secret, 11, n * _P64[0] & _64)


def _finish_128(low, high, n, seed):
    total = low + high & _64
    mixed = low * _P64[0] + high * _P64[3] + (n - seed) * _P64[1] & _64
    return (-_avalanche(mixed) & _64) << 64 | _avalanche(total)


def xxh3_128(data, seed=0):
    """The hash of at least 9 bytes: no record is shorter."""
    n = len(data)
    if n < 9:
        raise ValueError(f"{n} bytes are no record")
    if n <= 16:
        flip_low = (_r64(_SECRET, 32) ^ _r64(_SECRET, 40)) - seed & _64
        flip_high = (_r64(_SECRET, 48) ^ _r64(_SECRET, 56)) + seed & _64
        low, high = _r64(data, 0), _r64(data, n - 8)
        product = (low ^ high ^ flip_low) * _P64[0]
        a, b = (product & _64) + ((n - 1) << 54) & _64, product >> 64
        high ^= flip_high
        b = b + high + (high & 0xFFFFFFFF) * (_P32[1] - 1) & _64
        a ^= _swap64(b)
        product = a * _P64[1]
        return _avalanche((product >> 64) + b * _P64[1] & _64) << 64 | _avalanche(product & _64)
    if n <= 128:
        acc = [n * _P64[0] & _64, 0]
        for at, s in _pairs_from_the_ends(n):
            _mix32(acc, data, at, n - 16 - at, s, seed)
        return _finish_128(*acc, n, seed)
    if n <= 240:
        acc = [n * _P64[0] & _64, 0]
        for i in range(32, 160, 32):
            _mix32(acc, data, i - 32, i - 16, i - 32, seed)
        acc = [_avalanche(half) for half in acc]
        for i in range(160, n + 1, 32):
            _mix32(acc, data, i - 32, i - 16, 3 + i - 160, seed)
        _mix32(acc, data, n - 16, n - 32, 136 - 17 - 16, -seed & _64)
        return _finish_128(*acc, n, seed)
    acc, secret = _long(data, seed)
    high = _merge(acc, secret, 192 - 64 - 11, ~(n * _P64[1]) & _64)
    return high << 64 | _merge(acc, secret, 11, n * _P64[0] & _64)


def _fold_of_rows(a, b):
    """`_fold` of arrays: the 128-bit product by halves of 32 bits."""
    mask, half = np.uint64(0xFFFFFFFF), np.uint64(32)
    a0, a1, b0, b1 = a & mask, a >> half, b & mask, b >> half
    middle = a1 * b0 + (a0 * b0 >> half)
    high = a1 * b1 + (middle >> half) + ((middle & mask) + a0 * b1 >> half)
    return (a * b) ^ high


def _avalanche_of_rows(h):
    h = h ^ h >> np.uint64(37)
    h = h * np.uint64(_MX1)
    return h ^ h >> np.uint64(32)


def sum_of_records(rows):
    """Sum modulo 2^128 of the hashes of all rows of an array of bytes, each of 17 to 128 bytes."""
    count, n = rows.shape
    if not 17 <= n <= 128:
        raise ValueError(f"records of {n} bytes")
    if count == 0:
        return 0
    read = lambda at: np.ascontiguousarray(rows[:, at : at + 8]).view("<u8")[:, 0]
    secret = lambda s: np.uint64(_r64(_SECRET, s))
    mix = lambda at, s: _fold_of_rows(read(at) ^ secret(s), read(at + 8) ^ secret(s + 8))
    with np.errstate(over="ignore"):
        low, high = np.full(count, n * _P64[0] & _64, np.uint64), np.zeros(count, np.uint64)
        for at, s in _pairs_from_the_ends(n):
            one, other = at, n - 16 - at
            low = (low + mix(one, s)) ^ (read(other) + read(other + 8))
            high = (high + mix(other, s + 16)) ^ (read(one) + read(one + 8))
        mixed = low * np.uint64(_P64[0]) + high * np.uint64(_P64[3]) + np.uint64(n * _P64[1] & _64)
        sums = [_avalanche_of_rows(low + high), np.uint64(0) - _avalanche_of_rows(mixed)]
        # Halves of 32 bits, whose sums fit 64 bits.
        halves = [int(np.sum(x & np.uint64(0xFFFFFFFF))) + (int(np.sum(x >> np.uint64(32))) << 32) for x in sums]
    return halves[0] + (halves[1] << 64) & (1 << 128) - 1
