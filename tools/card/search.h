// One thread a query: a search within a radius that doubles until it holds k photons, as pm-gather makes it.
#pragma once
#include "candidates.h"
#include "reads.h"

// The k-th distance, squared, and what tells whether the other photons are right as well.
struct Answer {
    float farthest;
    uint32_t checksum;
};

// No map: what queries and answers cost by themselves.
struct NoMap {
    template <class Found>
    ON_CARD void nearest(Vector point, Found&, Reads& reads) const {
        // What nobody looks at is not read either.
        reads.touches += bits_of(length_squared(point)) & 1;
    }
};

// Queries and answers pass by once: they need not stay in the cache.
#ifdef __CUDA_ARCH__
ON_CARD float passing(const float* from) { return __ldcs(from); }
ON_CARD void pass(Answer* to, Answer answer) {
    __stcs(reinterpret_cast<float2*>(to), make_float2(answer.farthest, number_of(answer.checksum)));
}
#else
ON_CARD float passing(const float* from) { return *from; }
ON_CARD void pass(Answer* to, Answer answer) { *to = answer; }
#endif

template <class Map, class Places>
KERNEL void search(Map map, uint32_t photons, const float* queries, uint32_t count, float start, Answer* answers, Totals* totals) {
    const uint32_t at = blockIdx.x * blockDim.x + threadIdx.x;
    Reads reads;
    if (at < count) {
        const Vector point{passing(queries + size_t(at) * 3), passing(queries + size_t(at) * 3 + 1), passing(queries + size_t(at) * 3 + 2)};
        Candidates<Places> found;
        for (float radius = start;; radius = radius > 1e18f ? INFINITY : radius * 2.0f) {
            ++reads.attempts;
            found.restart(times(radius, radius));
            map.nearest(point, found, reads);
            // With all photons in hand a larger radius finds no more.
            if (found.is_full() || found.found() == photons || !(radius < INFINITY)) break;
        }
        pass(answers + at, {found.farthest(), found.checksum()});
    }
    add(totals, reads);
}
