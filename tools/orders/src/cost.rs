//! What an order costs: queries held, bytes on chip, and bytes that go to memory and back because the chip has no room.
//!
//! Records beyond the on-chip store are charged for every write and read that the order's own algorithm makes with a
//! store of that size, write and read buffers included. Files of this machine are none of it.

use pm_formats::vocabulary::measure;
use pm_formats::{Number, Query};

/// Bytes of a compact record: pixel and sample number in 42 bits, from which the ray is cast again, and a cell of the
/// scene in 30 bits, by which records are ordered.
pub const COMPACT_RECORD: u64 = 9;

/// Bytes of the buffer that each run or partition needs on chip, so that memory is read and written in bursts: two of
/// 128 bytes, one in use and one on its way.
pub const BURST_BUFFER: u64 = 256;

/// Rays that give a query back from its compact record: an eye ray and a gather ray, each with its reflections.
const RAYS_OF_A_COMPACT_RECORD: u64 = 2;

pm_registry::choices! {
    /// What is stored of a query while it waits.
    #[derive(Debug)]
    pub enum Record {
        /// All of it, 44 bytes
        Full = "full",
        /// Pixel, sample number and cell, 9 bytes; the ray is cast again
        Compact = "compact",
    }
}

impl Record {
    /// Its size in bytes.
    #[must_use]
    pub const fn bytes(self) -> u64 {
        match self {
            Self::Full => size_of::<Query>() as u64,
            Self::Compact => COMPACT_RECORD,
        }
    }
}

/// The on-chip store of an order.
#[derive(Clone, Copy, Debug)]
pub struct Store {
    /// Its size in bytes.
    pub bytes: u64,
    /// What is stored in it.
    pub record: Record,
}

impl Store {
    /// Queries for which there is room, at least one.
    #[must_use]
    pub fn room(self) -> u64 {
        (self.bytes / self.record.bytes()).max(1)
    }

    /// Runs that can be merged at once, or partitions that can be filled at once: at least two.
    #[must_use]
    pub fn fan(self) -> u64 {
        (self.bytes / BURST_BUFFER).max(2)
    }

    /// Records that are written and read again when `n` of them are sorted: by runs as long as the store, of which what
    /// fits stays on chip (Knuth, *The Art of Computer Programming* 3, 5.4), merged as many at once as have buffers.
    #[must_use]
    pub fn spilled_by_sort(self, n: u64) -> u64 {
        let beyond = n.saturating_sub(self.room());
        if beyond == 0 {
            return 0;
        }
        let (mut runs, mut passes) = (beyond.div_ceil(self.room()), 0);
        while runs > self.fan() {
            runs = runs.div_ceil(self.fan());
            passes += 1;
        }
        // While they are merged, buffers take the place of records, which go out as well.
        let pushed_out = (runs * BURST_BUFFER).div_ceil(self.record.bytes());
        (beyond + pushed_out).min(n) + passes * n
    }

    /// Passes over all records that it takes to put them into `parts` partitions.
    #[must_use]
    pub fn passes_to_part(self, parts: u64) -> u64 {
        let (mut reached, mut passes) = (self.fan(), 1);
        while reached < parts {
            reached = reached.saturating_mul(self.fan());
            passes += 1;
        }
        passes
    }
}

/// What is told of an order in the end block.
#[derive(Clone, Debug)]
pub(super) struct Costs {
    store: Store,
    deferred: u64,
    held: u64,
    peak: u64,
    /// Queries held on chip, now and at most.
    inside: u64,
    inside_peak: u64,
    on_chip: u64,
    tables: u64,
    written: u64,
    read: u64,
    more: Vec<(String, Number)>,
}

impl Costs {
    /// Nothing yet, with this store.
    #[must_use]
    pub(super) const fn new(store: Store) -> Self {
        Self {
            store,
            deferred: 0,
            held: 0,
            peak: 0,
            inside: 0,
            inside_peak: 0,
            on_chip: 0,
            tables: 0,
            written: 0,
            read: 0,
            more: vec![],
        }
    }

    /// The store.
    #[must_use]
    pub(super) const fn store(&self) -> Store {
        self.store
    }

    /// Bytes of tables that are on chip beside the store.
    pub(super) fn tables(&mut self, bytes: u64) {
        self.tables = bytes;
    }

    /// One more measure, set or replaced.
    pub(super) fn tell(&mut self, name: &str, number: Number) {
        self.more.retain(|(known, _)| known != name);
        self.more.push((name.to_owned(), number));
    }

    /// A query is held. True if there is room on chip; else it is written to memory.
    pub(super) fn admit(&mut self) -> bool {
        self.deferred += 1;
        self.held += 1;
        self.peak = self.peak.max(self.held);
        let inside = self.inside < self.store.room();
        if inside {
            self.inside += 1;
            self.inside_peak = self.inside_peak.max(self.inside);
        } else {
            self.written += 1;
        }
        inside
    }

    /// A query leaves, from on chip or read back.
    pub(super) fn release(&mut self, inside: bool) {
        self.held -= 1;
        if inside {
            self.inside -= 1;
        } else {
            self.read += 1;
        }
    }

    /// `n` queries were held together, `spilled` times a record was written and read, and `on_chip` bytes were used.
    pub(super) fn group(&mut self, n: u64, spilled: u64, on_chip: u64) {
        self.deferred += n;
        self.peak = self.peak.max(n);
        self.written += spilled;
        self.read += spilled;
        self.on_chip = self.on_chip.max(on_chip);
    }

    /// The measures, in the order in which they are shown.
    #[must_use]
    pub(super) fn measures(&self) -> Vec<(String, Number)> {
        let bytes = self.store.record.bytes();
        let on_chip = self.on_chip.max(self.inside_peak * bytes) + self.tables;
        let mut measures: Vec<(String, Number)> = [
            (measure::PEAK_QUERIES_HELD, Number::Count(self.peak)),
            (measure::STORAGE, Number::Bytes(self.peak * Record::Full.bytes())),
            (measure::STORAGE_COMPACT, Number::Bytes(self.peak * Record::Compact.bytes())),
            (measure::ON_CHIP, Number::Bytes(on_chip)),
            (measure::SPILLED_WRITTEN, Number::Bytes(self.written * bytes)),
            (measure::SPILLED_READ, Number::Bytes(self.read * bytes)),
        ]
        .map(|(name, number)| (name.to_owned(), number))
        .into();
        if self.store.record == Record::Compact {
            measures
                .push((measure::RAYS_CAST_AGAIN.to_owned(), Number::Count(self.deferred * RAYS_OF_A_COMPACT_RECORD)));
        }
        measures.extend(self.more.iter().cloned());
        measures
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn store(bytes: u64) -> Store {
        Store { bytes, record: Record::Full }
    }

    #[test]
    fn what_fits_is_not_spilled_and_a_sort_beyond_goes_out_and_in_once() {
        let store = store(44 * 1000);
        assert_eq!([0, 1, 1000].map(|n| store.spilled_by_sort(n)), [0; 3]);
        // One record too many: it goes out, and six more for the buffer of its run.
        assert_eq!(store.spilled_by_sort(1001), 1 + 6);
        // 100 runs: every record but about a store's worth, less than once.
        let spilled = store.spilled_by_sort(101_000);
        assert!((100_000..=101_000).contains(&spilled), "{spilled}");
        // 171 runs can be merged at once: beyond, all goes once more.
        assert_eq!(store.fan(), 171);
        let spilled = store.spilled_by_sort(1_000_000);
        assert!((1_999_000..=2_000_000).contains(&spilled), "{spilled}");
    }

    #[test]
    fn partitions_beyond_the_buffers_take_another_pass() {
        let store = store(256 * 10);
        assert_eq!([1, 10, 11, 100, 101].map(|parts| store.passes_to_part(parts)), [1, 1, 2, 2, 3]);
        // However little there is, it ends.
        assert!(Store { bytes: 0, record: Record::Full }.passes_to_part(u64::MAX) <= 64);
        assert!(Store { bytes: 0, record: Record::Full }.spilled_by_sort(1 << 40) > 0);
    }

    #[test]
    fn queries_beyond_the_store_are_written_and_read() {
        let mut costs = Costs::new(store(44 * 2));
        let inside: Vec<bool> = (0..4).map(|_| costs.admit()).collect();
        assert_eq!(inside, [true, true, false, false]);
        costs.release(true);
        assert!(costs.admit());
        inside.into_iter().for_each(|inside| costs.release(inside));
        let measure = |name: &str| {
            costs.measures().into_iter().find(|(known, _)| known == name).map(|(_, number)| number).unwrap()
        };
        assert_eq!(measure(measure::PEAK_QUERIES_HELD), Number::Count(4));
        assert_eq!(measure(measure::STORAGE), Number::Bytes(4 * 44));
        assert_eq!(measure(measure::STORAGE_COMPACT), Number::Bytes(4 * 9));
        assert_eq!(measure(measure::ON_CHIP), Number::Bytes(2 * 44));
        assert_eq!(measure(measure::SPILLED_WRITTEN), Number::Bytes(2 * 44));
        assert_eq!(measure(measure::SPILLED_READ), Number::Bytes(2 * 44));
    }
}
