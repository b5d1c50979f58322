//! An order at work on the queries of a batch, and where they leave it.

use super::Costs;
use pm_formats::{BLOCK_RECORDS, BlockMeta, Query};

/// A deferred order of the queries of a batch. Every query pushed leaves exactly once, by the end of `drain` at the latest;
/// after that the next batch may come.
pub trait Reorder {
    /// Takes queries; may let some go that it holds.
    ///
    /// # Errors
    /// Those of `out`, and of temporary files.
    fn push(&mut self, queries: &[Query], out: &mut Outlet<'_>) -> pm_formats::Result<()>;

    /// Lets go all that it holds.
    ///
    /// # Errors
    /// Those of `out`, and of temporary files.
    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()>;

    /// What the order cost so far.
    fn costs(&self) -> &Costs;
}

/// Takes what a reordering lets go: the block it belongs to, and its queries.
pub type Emit<'a> = dyn FnMut(BlockMeta, &[Query]) -> pm_formats::Result<()> + 'a;

/// Where queries leave an order, one after the other; they are emitted in blocks.
pub struct Outlet<'a> {
    meta: BlockMeta,
    leaving: &'a mut Vec<Query>,
    emit: &'a mut Emit<'a>,
}

impl<'a> Outlet<'a> {
    /// For queries of a block like this one; `leaving` is room that is used again.
    pub(super) fn new(meta: BlockMeta, leaving: &'a mut Vec<Query>, emit: &'a mut Emit<'a>) -> Self {
        Self { meta, leaving, emit }
    }

    /// A query leaves.
    ///
    /// # Errors
    /// If queries cannot be emitted.
    #[inline]
    pub fn leave(&mut self, query: Query) -> pm_formats::Result<()> {
        self.leaving.push(query);
        if self.leaving.len() == BLOCK_RECORDS { self.flush() } else { Ok(()) }
    }

    /// Emits what has left.
    pub(super) fn flush(&mut self) -> pm_formats::Result<()> {
        (self.emit)(self.meta, self.leaving)?;
        self.leaving.clear();
        Ok(())
    }
}
