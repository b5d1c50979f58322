// What searches read, counted.
#pragma once
#include "card.h"

// Of one thread.
struct Reads {
    // Whole records, once a visit, as a trace of pm-gather has them.
    uint32_t records = 0;
    // Loads of records from memory.
    uint32_t touches = 0;
    // Searches, each with a larger radius than the one before.
    uint32_t attempts = 0;
};

// Of all threads.
struct Totals {
    unsigned long long records, touches, attempts;
};

ON_CARD void add(Totals* totals, const Reads& reads) {
#ifdef __CUDA_ARCH__
    const unsigned all = 0xffffffff;
    const unsigned records = __reduce_add_sync(all, reads.records), touches = __reduce_add_sync(all, reads.touches),
                   attempts = __reduce_add_sync(all, reads.attempts);
    if (threadIdx.x % 32 == 0) {
        atomicAdd(&totals->records, records);
        atomicAdd(&totals->touches, touches);
        atomicAdd(&totals->attempts, attempts);
    }
#else
    totals->records += reads.records;
    totals->touches += reads.touches;
    totals->attempts += reads.attempts;
#endif
}
