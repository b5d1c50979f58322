"""Counts of pycachesim, an independent simulator, for a trace: misses and dirty lines written back.

    pm-view --export xdin trace.pmt | python3 scripts/pycachesim_counts.py SETS WAYS LINE

reads lines `r|w address size` (hexadecimal), as Dinero IV does, and prints `misses write_backs`.
"""

import sys

from cachesim import Cache, CacheSimulator, MainMemory

sets, ways, line = (int(word) for word in sys.argv[1:4])
memory = MainMemory()
cache = Cache("L1", sets, ways, line, "LRU")
memory.load_to(cache)
memory.store_from(cache)
simulator = CacheSimulator(cache, memory)
for entry in sys.stdin:
    kind, address, size = entry.split()[:3]
    access = simulator.load if kind == "r" else simulator.store
    access(int(address, 16), length=int(size, 16))
simulator.force_write_back()
statistics = {level["name"]: level for level in simulator.stats()}
print(statistics["L1"]["MISS_count"], statistics["L1"]["EVICT_count"])
