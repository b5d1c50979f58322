// The kd-tree with leaves of one line, as `pm-gather --map bucket-kd` has it: splits of 8 bytes, leaves of 128.
#pragma once
#include "photons.h"
#include "reads.h"

constexpr uint32_t LEAF_WORDS = 32, LEAF_PHOTONS = LEAF_WORDS / 5;

struct Buckets {
    // The largest coordinate on the left, rounded up to a multiple of four units in the last place, with the axis in the
    // bits that this leaves; the least coordinate on the right. Node i at index i - 1.
    std::vector<Pair> splits;
    // Photons one after another, NaN where there is none.
    std::vector<uint32_t> leaves;
};

inline Buckets build_buckets(const std::vector<Record>& photons) {
    const size_t leaves = (photons.size() + LEAF_PHOTONS - 1) / LEAF_PHOTONS;
    Buckets tree;
    tree.splits.resize(leaves > 0 ? leaves - 1 : 0);
    tree.leaves.assign(leaves * LEAF_WORDS, bits_of(NAN));
    struct Builder {
        const std::vector<Record>& photons;
        Buckets& tree;

        void divide(size_t at, size_t leaves, Point* from, Point* to) const {
            if (leaves == 1) {
                uint32_t* leaf = &tree.leaves[(at - 1 - tree.splits.size()) * LEAF_WORDS];
                for (; from < to; ++from, leaf += 5) std::copy_n(photons[from->id].words, 5, leaf);
                return;
            }
            // A tree of n leaves has 2n - 1 nodes.
            const size_t left = (left_size(2 * leaves - 1) + 1) / 2;
            const unsigned axis = extent(from, to).longest();
            Point* middle = from + left * LEAF_PHOTONS;
            split(from, middle, to, axis);
            float low = -INFINITY;
            for (const Point* point = from; point < middle; ++point) low = std::max(low, point->position.along(axis));
            const uint32_t bits = bits_of(low);
            // Up is away from zero above it and towards zero below it.
            const uint32_t up = bits >> 31 ? bits & ~3u : (bits + 3) & ~3u;
            tree.splits[at - 1] = {up | axis, bits_of(middle->position.along(axis))};
            both(at, [=, this] { divide(2 * at, left, from, middle); }, [=, this] { divide(2 * at + 1, leaves - left, middle, to); });
        }
    };
    std::vector<Point> points = points_of(photons);
    if (leaves > 0) Builder{photons, tree}.divide(1, leaves, points.data(), points.data() + points.size());
    return tree;
}

// The search: depth first, the nearer child first, a subtree's distance that of its cell, kept up to date plane by plane.
struct BucketTree {
    const Pair* splits;
    const uint32_t* leaves;
    uint32_t inner, photons;

    struct Later {
        uint32_t at;
        float distance;
        Vector offsets;
    };

    template <class Found>
    ON_CARD void nearest(Vector point, Found& found, Reads& reads) const {
        if (photons == 0) return;
        Later later[32];
        int depth = 0;
        uint32_t at = 1;
        Vector offsets{0, 0, 0};
        for (;;) {
            ++reads.records;
            ++reads.touches;
            if (at <= inner) {
                const Pair split = splits[at - 1];
                const unsigned axis = split.x & 3;
                const float low = number_of(split.x & ~3u), high = number_of(split.y);
                // How far outside the one and the other child; negative inside.
                const float beyond_left = minus(point.along(axis), low), beyond_right = minus(high, point.along(axis));
                const bool leftwards = beyond_left <= beyond_right;
                const float near_offset = leftwards ? beyond_left : beyond_right, far_offset = leftwards ? beyond_right : beyond_left;
                const uint32_t near = 2 * at + (leftwards ? 0 : 1);
                Vector far_offsets = offsets;
                far_offsets.set(axis, fmaxf(offsets.along(axis), far_offset));
                const float distance = length_squared(far_offsets);
                if (distance <= found.bound) later[depth++] = {near ^ 1, distance, far_offsets};
                offsets.set(axis, fmaxf(offsets.along(axis), near_offset));
                // Not so where the query lies in the gap between the two.
                if (near_offset <= 0.0f || length_squared(offsets) <= found.bound) {
                    at = near;
                    continue;
                }
            } else {
                leaf(at - 1 - inner, point, found);
            }
            do {
                if (depth == 0) return;
                --depth;
            } while (!(later[depth].distance <= found.bound));
            at = later[depth].at;
            offsets = later[depth].offsets;
        }
    }

    // A leaf is read as a whole.
    template <class Found>
    ON_CARD void leaf(uint32_t leaf, Vector point, Found& found) const {
        Quad quads[LEAF_WORDS / 4];
        const Quad* line = reinterpret_cast<const Quad*>(leaves + size_t(leaf) * LEAF_WORDS);
#pragma unroll 8
        for (uint32_t at = 0; at < LEAF_WORDS / 4; ++at) quads[at] = line[at];
#pragma unroll 8
        for (uint32_t at = 0; at < LEAF_PHOTONS; ++at) {
            const Vector position{number_of(word(quads, 5 * at)), number_of(word(quads, 5 * at + 1)), number_of(word(quads, 5 * at + 2))};
            found.show(distance_squared(point, position), leaf * LEAF_PHOTONS + at);
        }
    }

    static ON_CARD uint32_t word(const Quad* quads, uint32_t at) {
        const Quad quad = quads[at / 4];
        return at % 4 == 0 ? quad.x : at % 4 == 1 ? quad.y : at % 4 == 2 ? quad.z : quad.w;
    }
};
