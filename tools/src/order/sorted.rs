//! Orders that sort by a key: all of a batch, or all of the image, has to be held.

use super::{Emit, Per, Reorder};
use pm_formats::{BlockMeta, Number, Query};

/// Sorts queries by a 32-bit key; equal keys keep the order in which they came.
pub struct Sorted<K> {
    key: K,
    per: Per,
    meta: Option<BlockMeta>,
    held: Vec<Query>,
    peak: usize,
}

impl<K: Fn(&[Query]) -> Vec<u32>> Sorted<K> {
    /// An order whose keys `key` computes, for many queries at once.
    pub const fn new(per: Per, key: K) -> Self {
        Self { key, per, meta: None, held: vec![], peak: 0 }
    }
}

impl<K: Fn(&[Query]) -> Vec<u32>> Reorder for Sorted<K> {
    fn push(&mut self, meta: BlockMeta, queries: &[Query], emit: &mut Emit<'_>) -> pm_formats::Result<()> {
        let meta = match self.per {
            Per::Batch => BlockMeta { records: 0, ..meta },
            Per::Image => BlockMeta::default(),
        };
        if self.meta.is_some_and(|held| held != meta) {
            self.drain(emit)?;
        }
        self.meta = Some(meta);
        self.held.extend_from_slice(queries);
        self.peak = self.peak.max(self.held.len());
        Ok(())
    }

    fn drain(&mut self, emit: &mut Emit<'_>) -> pm_formats::Result<()> {
        let Some(meta) = self.meta.take() else { return Ok(()) };
        // Only (key, place) is sorted; each record moves once.
        let keys = (self.key)(&self.held);
        let mut places: Vec<u64> = (0u64..).zip(keys).map(|(place, key)| u64::from(key) << 32 | place).collect();
        assert!(places.len() <= 1 << 32, "more than 2^32 queries cannot be sorted at once");
        places.sort_unstable();
        let mut out = Vec::with_capacity(places.len().min(pm_formats::BLOCK_RECORDS));
        for chunk in places.chunks(pm_formats::BLOCK_RECORDS) {
            out.clear();
            out.extend(chunk.iter().map(|&place| self.held[(place & 0xffff_ffff) as usize]));
            emit(meta, &out)?;
        }
        self.held.clear();
        Ok(())
    }

    fn measures(&self) -> Vec<(String, Number)> {
        let peak = self.peak as u64;
        vec![
            ("peak_queries_held".into(), Number::Count(peak)),
            ("storage".into(), Number::Bytes(peak * size_of::<Query>() as u64)),
        ]
    }
}
