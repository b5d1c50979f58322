// The k nearest photons so far: a bounded list, and where a thread keeps it.
#pragma once
#include "arithmetic.h"

#ifndef K
#define K 100
#endif

// What is kept of a photon. Of non-negative floats the bits order as the numbers do.
struct Distance {
    using Key = uint32_t;
    static ANYWHERE Key key(float distance, uint32_t) { return bits_of(distance); }
    static ANYWHERE uint32_t distance_bits(Key key) { return key; }
};

// As pm keeps it: distance, then photon.
struct DistanceAndPhoton {
    using Key = uint64_t;
    static ANYWHERE Key key(float distance, uint32_t photon) { return uint64_t(bits_of(distance)) << 32 | photon; }
    static ANYWHERE uint32_t distance_bits(Key key) { return uint32_t(key >> 32); }
};

// Places of the list in the memory that the threads of a block share, each thread's in a bank of its own.
template <class Kind_>
struct InShared {
    using Kind = Kind_;
    typename Kind::Key* first;
    static constexpr size_t bytes = K * sizeof(typename Kind::Key);

    ON_CARD InShared() {
#ifdef __CUDA_ARCH__
        extern __shared__ uint64_t shared_memory[];
        first = reinterpret_cast<typename Kind::Key*>(shared_memory) + threadIdx.x;
#elif !defined(__CUDACC__)
        first = reinterpret_cast<typename Kind::Key*>(shared_memory.data()) + threadIdx.x;
#endif
    }
    ON_CARD typename Kind::Key& operator[](int at) { return first[at * blockDim.x]; }
};

// Places of the list in the thread's own part of the card's memory, behind the same caches as the map.
template <class Kind_>
struct InLocal {
    using Kind = Kind_;
    typename Kind::Key keys[K];
    static constexpr size_t bytes = 0;

    ON_CARD typename Kind::Key& operator[](int at) { return keys[at]; }
};

// Unordered until there are k photons, then a heap with the farthest first, and a bound that shrinks.
template <class Places>
class Candidates {
    using Kind = typename Places::Kind;
    using Key = typename Kind::Key;

    Places places;
    int count = 0;

   public:
    // Largest squared distance that a photon may still have.
    float bound;

    ON_CARD void restart(float radius_squared) {
        count = 0;
        bound = radius_squared;
    }

    ON_CARD bool is_full() const { return count == K; }
    ON_CARD uint32_t found() const { return uint32_t(count); }

    ON_CARD void show(float distance, uint32_t photon) {
        // Also false for NaN.
        if (!(distance <= bound)) return;
        const Key key = Kind::key(distance, photon);
        if (count < K) {
            places[count++] = key;
            if (count == K) {
                for (int at = K / 2 - 1; at >= 0; --at) sift_down(at, places[at]);
                tighten();
            }
        } else if (key < places[0]) {
            sift_down(0, key);
            tighten();
        }
    }

    // Squared distance of the k-th photon; where there are fewer, that of the farthest; 0 for none.
    ON_CARD float farthest() {
        uint32_t most = 0;
        for (int at = 0; at < count; ++at) most = max_of(most, Kind::distance_bits(places[at]));
        return number_of(most);
    }

    // Sum of the bits of all distances: the same for whoever found the same photons, in whatever order.
    ON_CARD uint32_t checksum() {
        uint32_t sum = 0;
        for (int at = 0; at < count; ++at) sum += Kind::distance_bits(places[at]);
        return sum;
    }

   private:
    static ON_CARD uint32_t max_of(uint32_t a, uint32_t b) { return a > b ? a : b; }

    ON_CARD void tighten() { bound = number_of(Kind::distance_bits(places[0])); }

    ON_CARD void sift_down(int at, Key key) {
        for (;;) {
            int child = 2 * at + 1;
            if (child >= K) break;
            Key larger = places[child];
            if (child + 1 < K) {
                const Key right = places[child + 1];
                if (right > larger) {
                    larger = right;
                    ++child;
                }
            }
            if (larger <= key) break;
            places[at] = larger;
            at = child;
        }
        places[at] = key;
    }
};
