//! What an order costs: queries held, bytes on chip, and bytes that go to memory and back because the chip has no room.
//!
//! Records beyond the on-chip store are charged for every write and read that the order's own algorithm makes with a
//! store of that size, write and read buffers included. Files of this machine are none of it.

use super::{Store, StoredQuery};
use pm_formats::Number;
use pm_formats::vocabulary::measure;

/// Rays that give a query back, as from its compact record: an eye ray and a gather ray, each with its reflections.
const RAYS_OF_A_QUERY: u64 = 2;

/// What is told of an order in the end block.
#[derive(Clone, Debug)]
pub struct Costs {
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
    /// Rays cast again for queries that were not answered when they were cast.
    again: u64,
    more: Vec<(String, Number)>,
}

impl Costs {
    /// Nothing yet, with this store.
    #[must_use]
    pub const fn new(store: Store) -> Self {
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
            again: 0,
            more: vec![],
        }
    }

    /// The store.
    #[must_use]
    pub const fn store(&self) -> Store {
        self.store
    }

    /// Bytes of tables that are on chip beside the store.
    #[must_use]
    pub const fn tables(&self) -> u64 {
        self.tables
    }

    /// So many bytes of tables are on chip beside the store.
    pub const fn set_tables(&mut self, bytes: u64) {
        self.tables = bytes;
    }

    /// One more measure, set or replaced.
    pub fn tell(&mut self, name: &str, number: Number) {
        self.more.retain(|(known, _)| known != name);
        self.more.push((name.to_owned(), number));
    }

    /// A query is held. True if there is room on chip; else it is written to memory.
    pub fn admit(&mut self) -> bool {
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
    pub fn release(&mut self, inside: bool) {
        self.held -= 1;
        if inside {
            self.inside -= 1;
        } else {
            self.read += 1;
        }
    }

    /// `n` queries were held together, `spilled` times a record was written and read, and `on_chip` bytes were used.
    pub fn group(&mut self, n: u64, spilled: u64, on_chip: u64) {
        self.deferred += n;
        self.peak = self.peak.max(n);
        self.written += spilled;
        self.read += spilled;
        self.on_chip = self.on_chip.max(on_chip);
    }

    /// So many queries were cast once more, since nothing was kept of them.
    pub const fn cast_again(&mut self, queries: u64) {
        self.again += queries * RAYS_OF_A_QUERY;
    }

    /// The measures, in the order in which they are shown.
    #[must_use]
    pub fn measures(&self) -> Vec<(String, Number)> {
        let bytes = self.store.record.bytes();
        let on_chip = self.on_chip.max(self.inside_peak * bytes) + self.tables;
        let mut measures: Vec<(String, Number)> = [
            (measure::PEAK_QUERIES_HELD, Number::Count(self.peak)),
            (measure::STORAGE, Number::Bytes(self.peak * StoredQuery::Full.bytes())),
            (measure::STORAGE_COMPACT, Number::Bytes(self.peak * StoredQuery::Compact.bytes())),
            (measure::ON_CHIP, Number::Bytes(on_chip)),
            (measure::SPILLED_WRITTEN, Number::Bytes(self.written * bytes)),
            (measure::SPILLED_READ, Number::Bytes(self.read * bytes)),
        ]
        .map(|(name, number)| (name.to_owned(), number))
        .into();
        let compact = self.store.record == StoredQuery::Compact;
        let again = self.again + if compact { self.deferred * RAYS_OF_A_QUERY } else { 0 };
        if compact || again > 0 {
            measures.push((measure::RAYS_CAST_AGAIN.to_owned(), Number::Count(again)));
        }
        measures.extend(self.more.iter().cloned());
        measures
    }
}

#[cfg(test)]
mod tests;
