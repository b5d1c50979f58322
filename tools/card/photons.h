// Photons as they stand in a stream, and sorting them into trees on all cores of the host.
#pragma once
#include <cmath>
#include <future>

#include "arithmetic.h"

// A photon of a stream, 20 bytes (formats/README.md); in a kd-tree bits 16 and 17 of the last word are its split axis.
struct Record {
    uint32_t words[5];

    Vector position() const { return {number_of(words[0]), number_of(words[1]), number_of(words[2])}; }
};
static_assert(sizeof(Record) == 20);

// A photon that is being sorted: where it is, and which it is.
struct Point {
    Vector position;
    uint32_t id;
};

inline std::vector<Point> points_of(const std::vector<Record>& photons) {
    std::vector<Point> points;
    points.reserve(photons.size());
    for (uint32_t id = 0; id < photons.size(); ++id) points.push_back({photons[id].position(), id});
    return points;
}

struct Box {
    Vector low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

    // The first of the longest sides.
    unsigned longest() const {
        unsigned longest = 0;
        for (unsigned axis = 1; axis < 3; ++axis)
            if (high.along(axis) - low.along(axis) > high.along(longest) - low.along(longest)) longest = axis;
        return longest;
    }
};

inline Box extent(const Point* from, const Point* to) {
    Box box;
    for (; from < to; ++from)
        for (unsigned axis = 0; axis < 3; ++axis) {
            box.low.set(axis, std::min(box.low.along(axis), from->position.along(axis)));
            box.high.set(axis, std::max(box.high.along(axis), from->position.along(axis)));
        }
    return box;
}

// Puts the photon that belongs at `middle` there and smaller ones before it: by coordinate, then by id.
inline void split(Point* from, Point* middle, Point* to, unsigned axis) {
    std::nth_element(from, middle, to, [axis](const Point& a, const Point& b) {
        const float x = a.position.along(axis), y = b.position.along(axis);
        return x < y || (x == y && a.id < b.id);
    });
}

// Number of nodes in the left subtree of a left-balanced tree of n nodes.
inline size_t left_size(size_t n) {
    if (n < 2) return 0;
    size_t full = 1;
    while (full * 2 <= n) full *= 2;
    return (full / 2 - 1) + std::min(n - (full - 1), full / 2);
}

// Two halves of a build: side by side near the root, one after the other below.
template <class Left, class Right>
void both(size_t node, Left left, Right right) {
    if (node < 64) {
        auto other = std::async(std::launch::async, left);
        right();
        other.get();
    } else {
        left();
        right();
    }
}
