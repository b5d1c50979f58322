//! A foreign trace in blocks of searches, as streams of ours have: what follows one another makes a search of no query.

use pm_formats::BlockMeta;
use pm_formats::trace::{Access, TraceSink};

/// Accesses of a search.
const SEARCH: u32 = 1 << 16;
/// Searches of a block: its accesses as addresses of 64 bits are a quarter of the longest payload, and what repeats in them is
/// found again.
const BLOCK: u32 = 32;

/// Cuts what is replayed into searches and blocks, and says when a block ends.
pub(super) struct InBlocks<'a, S, F> {
    sink: &'a mut S,
    end_block: F,
    warm_up: bool,
    /// Accesses of the search in hand; none if there is no search.
    accesses: u32,
    /// Searches of the block in hand.
    searches: u32,
    fault: Option<anyhow::Error>,
}

impl<'a, S: TraceSink, F: FnMut(&mut S, BlockMeta) -> anyhow::Result<()>> InBlocks<'a, S, F> {
    pub(super) fn new(sink: &'a mut S, end_block: F) -> Self {
        Self { sink, end_block, warm_up: false, accesses: 0, searches: 0, fault: None }
    }

    /// What went wrong so far.
    pub(super) fn check(&mut self) -> anyhow::Result<()> {
        self.fault.take().map_or(Ok(()), Err)
    }

    /// Ends the last block.
    pub(super) fn finish(mut self) -> anyhow::Result<()> {
        self.end();
        self.check()
    }

    fn end(&mut self) {
        if self.accesses > 0 {
            self.end_search();
        }
        if self.searches > 0 {
            self.searches = 0;
            let meta = BlockMeta { batch: 0, warm_up: self.warm_up, records: 0 };
            if let Err(fault) = (self.end_block)(self.sink, meta) {
                self.fault.get_or_insert(fault);
            }
        }
    }

    fn end_search(&mut self) {
        self.sink.search_end();
        self.accesses = 0;
        self.searches += 1;
    }
}

impl<S: TraceSink, F: FnMut(&mut S, BlockMeta) -> anyhow::Result<()>> TraceSink for InBlocks<'_, S, F> {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.end();
        self.warm_up = warm_up;
        self.sink.block(batch, warm_up);
    }

    fn access(&mut self, access: Access) {
        if self.accesses == 0 {
            self.sink.search(&[]);
        }
        self.sink.access(access);
        self.accesses += 1;
        if self.accesses == SEARCH {
            self.end_search();
            if self.searches == BLOCK {
                self.end();
            }
        }
    }
}
