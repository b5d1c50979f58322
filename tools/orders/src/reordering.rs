//! An order at work on a stream: which queries it holds together, and how they leave.

use super::{Emit, Outlet, Reorder};
use pm_formats::{BlockMeta, Number, Query};

pm_registry::choices! {
    /// How far an order may look.
    #[derive(Debug)]
    pub enum Per {
        /// Each batch (tile or scanline) by itself, as it stands in the stream
        Batch = "batch",
        /// The whole image, which then is one batch
        Image = "image",
    }
}

impl Per {
    /// What is to be held together with queries of this block.
    const fn batch_of(self, meta: BlockMeta) -> BlockMeta {
        match self {
            Self::Batch => BlockMeta { records: 0, ..meta },
            Self::Image => BlockMeta { batch: 0, warm_up: false, records: 0 },
        }
    }
}

/// An order, applied to each batch of a stream or to the image.
pub struct Reordering {
    per: Per,
    order: Box<dyn Reorder>,
    /// What the queries in hand belong to.
    held: Option<BlockMeta>,
    leaving: Vec<Query>,
}

impl Reordering {
    /// Nothing has come yet.
    #[must_use]
    pub const fn new(per: Per, order: Box<dyn Reorder>) -> Self {
        Self { per, order, held: None, leaving: vec![] }
    }

    /// Takes queries of one block; may emit some that are held.
    ///
    /// # Errors
    /// Those of `emit`, and of the order's temporary files.
    pub fn push(&mut self, meta: BlockMeta, queries: &[Query], emit: &mut Emit<'_>) -> pm_formats::Result<()> {
        let meta = self.per.batch_of(meta);
        if self.held.is_some_and(|held| held != meta) {
            self.drain(emit)?;
        }
        self.held = Some(meta);
        let mut outlet = Outlet::new(meta, &mut self.leaving, emit);
        self.order.push(queries, &mut outlet)?;
        outlet.flush()
    }

    /// Emits all that is held.
    ///
    /// # Errors
    /// Those of `emit`, and of the order's temporary files.
    pub fn drain(&mut self, emit: &mut Emit<'_>) -> pm_formats::Result<()> {
        let Some(meta) = self.held.take() else { return Ok(()) };
        let mut outlet = Outlet::new(meta, &mut self.leaving, emit);
        self.order.drain(&mut outlet)?;
        outlet.flush()
    }

    /// The order at work.
    #[must_use]
    pub fn order(&self) -> &dyn Reorder {
        &*self.order
    }

    /// What the order cost, for the end block.
    #[must_use]
    pub fn measures(&self) -> Vec<(String, Number)> {
        self.order.costs().measures()
    }
}
