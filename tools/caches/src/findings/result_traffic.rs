//! Result traffic: what it costs to add each query's radiance to its pixel.
//!
//! The trace says which pixels (or cached irradiance records) a search serves, not where they lie. Here they are an array
//! in memory, row by row; each query is one read-modify-write of its pixel, through a cache of its own:
//!
//! * in general a fully associative write-back LRU cache of sectors, in which every sector that is fetched is also written
//!   back, when it leaves or at the end;
//! * where a batch is a tile whose pixels fit in that cache, they stay on chip until the batch is over; then each sector
//!   that the batch touched is written once, and none is read, since all of a pixel's queries are in its tile.

use std::collections::{BTreeSet, HashMap, VecDeque};

/// How results are held and where they go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResultMemory {
    /// Size of the result cache in bytes.
    pub cache_bytes: u64,
    /// Bytes of a pixel in memory.
    pub pixel_bytes: u32,
    /// Pixels of a tile, if each batch of the trace is one.
    pub tile_pixels: Option<u64>,
}

/// Bytes of a sector: what memory reads or writes at a time, as GPUs and DRAM bursts have it.
pub const SECTOR_BYTES: u64 = 32;

impl ResultMemory {
    /// Whether the pixels of a tile stay on chip.
    #[must_use]
    pub fn holds_tiles(&self) -> bool {
        let bytes = |pixels: u64| pixels.checked_mul(self.pixel_bytes.into());
        self.tile_pixels.and_then(bytes).is_some_and(|bytes| bytes <= self.cache_bytes)
    }
}

/// Counts result traffic.
pub(crate) struct ResultTraffic {
    memory: ResultMemory,
    /// Sectors in the cache: when each was last used, and whether it is dirty by a query that counts.
    cached: HashMap<u64, Cached>,
    /// Times at which sectors were used, in order, and which: the last use of each that is in the cache, and earlier ones.
    uses: VecDeque<(u64, u64)>,
    now: u64,
    /// The tile in hand, and its sectors.
    tile: (u64, BTreeSet<u64>),
    sectors_read: u64,
    sectors_written: u64,
}

struct Cached {
    time: u64,
    dirty: bool,
}

impl ResultTraffic {
    pub(crate) fn new(memory: ResultMemory) -> Self {
        Self {
            memory,
            cached: HashMap::new(),
            uses: VecDeque::new(),
            now: 0,
            tile: (0, BTreeSet::new()),
            sectors_read: 0,
            sectors_written: 0,
        }
    }

    /// A search of a batch has results for these pixels. Warm-up is not counted.
    pub(crate) fn search(&mut self, batch: u64, pixels: &[u32], counted: bool) {
        let on_chip = self.memory.holds_tiles();
        if on_chip && self.tile.0 != batch {
            self.write_tile();
            self.tile.0 = batch;
        }
        for &pixel in pixels {
            let first = u64::from(pixel) * u64::from(self.memory.pixel_bytes);
            let last = first + u64::from(self.memory.pixel_bytes) - 1;
            for sector in first / SECTOR_BYTES..=last / SECTOR_BYTES {
                match on_chip {
                    false => self.touch(sector, counted),
                    true if counted => {
                        self.tile.1.insert(sector);
                    }
                    true => {}
                }
            }
        }
    }

    /// Reads, changes and writes a sector through the cache. Every write-back is charged when the sector turns dirty.
    fn touch(&mut self, sector: u64, counted: bool) {
        let sectors = self.memory.cache_bytes / SECTOR_BYTES;
        // A cache of less than a sector holds nothing.
        if sectors == 0 {
            self.sectors_read += u64::from(counted);
            self.sectors_written += u64::from(counted);
            return;
        }
        self.now += 1;
        self.uses.push_back((self.now, sector));
        match self.cached.get_mut(&sector) {
            Some(cached) => {
                self.sectors_written += u64::from(counted && !cached.dirty);
                *cached = Cached { time: self.now, dirty: cached.dirty || counted };
            }
            None => {
                self.sectors_read += u64::from(counted);
                self.sectors_written += u64::from(counted);
                if self.cached.len() as u64 >= sectors {
                    self.evict();
                }
                self.cached.insert(sector, Cached { time: self.now, dirty: counted });
            }
        }
        // Uses that are not the last of their sector go when they are as many again.
        if self.uses.len() > 2 * self.cached.len() + 64 {
            let cached = &self.cached;
            self.uses.retain(|(time, sector)| cached.get(sector).is_some_and(|cached| cached.time == *time));
        }
    }

    /// The sector used least recently leaves.
    fn evict(&mut self) {
        while let Some((time, sector)) = self.uses.pop_front() {
            if self.cached.get(&sector).is_some_and(|cached| cached.time == time) {
                self.cached.remove(&sector);
                return;
            }
        }
    }

    fn write_tile(&mut self) {
        self.sectors_written += self.tile.1.len() as u64;
        self.tile.1.clear();
    }

    /// Bytes read and written.
    pub(crate) fn finish(mut self) -> u64 {
        self.write_tile();
        (self.sectors_read + self.sectors_written) * SECTOR_BYTES
    }
}
