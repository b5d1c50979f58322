// Distances in the operations, and in the order of operations, of pm's own maps: each rounded, none fused.
#pragma once
#include <cmath>

#include "card.h"

// Words that are loaded together.
struct alignas(8) Pair {
    uint32_t x, y;
};
struct alignas(16) Quad {
    uint32_t x, y, z, w;
};

struct Vector {
    float x, y, z;

    ANYWHERE float along(unsigned axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

    ANYWHERE void set(unsigned axis, float value) {
        x = axis == 0 ? value : x;
        y = axis == 1 ? value : y;
        z = axis == 2 ? value : z;
    }
};

#ifdef __CUDA_ARCH__
ANYWHERE float times(float a, float b) { return __fmul_rn(a, b); }
ANYWHERE float plus(float a, float b) { return __fadd_rn(a, b); }
ANYWHERE float minus(float a, float b) { return __fsub_rn(a, b); }
ANYWHERE uint32_t bits_of(float number) { return __float_as_uint(number); }
ANYWHERE float number_of(uint32_t bits) { return __uint_as_float(bits); }
#else
// Compiled with -ffp-contract=off.
inline float times(float a, float b) { return a * b; }
inline float plus(float a, float b) { return a + b; }
inline float minus(float a, float b) { return a - b; }
inline uint32_t bits_of(float number) {
    uint32_t bits;
    __builtin_memcpy(&bits, &number, 4);
    return bits;
}
inline float number_of(uint32_t bits) {
    float number;
    __builtin_memcpy(&number, &bits, 4);
    return number;
}
#endif

ANYWHERE float length_squared(Vector v) { return plus(plus(times(v.x, v.x), times(v.y, v.y)), times(v.z, v.z)); }

ANYWHERE float distance_squared(Vector a, Vector b) {
    return length_squared({minus(a.x, b.x), minus(a.y, b.y), minus(a.z, b.z)});
}
