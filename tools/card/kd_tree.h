// The left-balanced kd-tree of the paper, as `pm-gather --map kd` has it: 20-byte nodes, children of node i at 2i and 2i + 1.
#pragma once
#include "photons.h"
#include "reads.h"

// Node i at index i - 1.
inline std::vector<Record> build_kd_tree(const std::vector<Record>& photons) {
    std::vector<Record> nodes(photons.size());
    std::vector<Point> points = points_of(photons);
    struct Builder {
        const std::vector<Record>& photons;
        std::vector<Record>& nodes;

        void balance(size_t at, Point* from, Point* to, Box cell) const {
            if (from == to) return;
            const unsigned axis = cell.longest();
            Point* median = from + left_size(size_t(to - from));
            split(from, median, to, axis);
            Record& node = nodes[at - 1] = photons[median->id];
            node.words[4] = (node.words[4] & ~(3u << 16)) | axis << 16;
            Box left = cell, right = cell;
            left.high.set(axis, median->position.along(axis));
            right.low.set(axis, median->position.along(axis));
            both(at, [=, this] { balance(2 * at, from, median, left); }, [=, this] { balance(2 * at + 1, median + 1, to, right); });
        }
    };
    Point* first = points.data();
    Builder{photons, nodes}.balance(1, first, first + points.size(), extent(first, first + points.size()));
    return nodes;
}

// The search: Jensen's, with its reads in pm's order, but without a stack. One bit a level says whether the second child is
// still to be looked at; what else a stack would hold is found in the node, which is touched again on the way back.
struct KdTree {
    const Record* nodes;
    uint32_t count;

    struct Node {
        Vector position;
        unsigned axis;
    };

    ON_CARD Node node(uint32_t at) const {
        const uint32_t* words = nodes[at - 1].words;
        return {{number_of(words[0]), number_of(words[1]), number_of(words[2])}, words[4] >> 16 & 3};
    }

    template <class Found>
    ON_CARD void nearest(Vector point, Found& found, Reads& reads) const {
        if (count == 0) return;
        uint32_t at = 1, level = 1, later = 0;
        bool downwards = true;
        for (;;) {
            const Node node = this->node(at);
            ++reads.touches;
            const float delta = minus(point.along(node.axis), node.position.along(node.axis));
            const bool within = times(delta, delta) <= found.bound;
            const uint32_t left = 2 * at, near = delta > 0.0f ? left + 1 : left, far = near ^ 1;
            uint32_t next = 0;
            if (downwards) {
                ++reads.records;
                if (near <= count) {
                    next = near;
                    later = far <= count ? later | level : later & ~level;
                } else {
                    later &= ~level;
                    // The only child lies on the other side.
                    if (far <= count && within) next = far;
                }
            } else if (later & level) {
                later &= ~level;
                if (within) next = far;
            }
            if (next != 0) {
                at = next;
                level <<= 1;
                downwards = true;
                continue;
            }
            found.show(distance_squared(point, node.position), at);
            if (at == 1) return;
            at >>= 1;
            level >>= 1;
            downwards = false;
        }
    }
};
