//! Lanes that each have a batch of their own.

use std::io;

use pm_formats::trace::Access;
use pm_spool::Spool;

use super::parts::fly;
use super::{LaneSink, Listener, Origin};

/// The batches in hand, at most as many as there are lanes.
pub(super) struct Batches {
    spool: Spool,
    /// Where each begins, and what it is.
    begun: Vec<(u64, Origin)>,
}

impl Batches {
    pub(super) fn new() -> io::Result<Self> {
        Ok(Self { spool: Spool::new()?, begun: vec![] })
    }

    /// A search comes in. If it begins a batch that no lane is free for, those that wait fly first.
    pub(super) fn begin<S: LaneSink>(
        &mut self,
        origin: Origin,
        destinations: &[u32],
        lanes: usize,
        listener: &mut Listener<S>,
    ) -> io::Result<()> {
        if self.begun.last().is_none_or(|(_, last)| last.batch != origin.batch) {
            if self.begun.len() == lanes {
                self.play(listener)?;
            }
            self.begun.push((self.spool.mark(), origin));
        } else {
            // Each search is read by itself.
            self.spool.mark();
        }
        self.spool.search(origin.warm_up, destinations)
    }

    /// An access of it.
    #[inline]
    pub(super) fn access(&mut self, access: Access) -> io::Result<()> {
        assert!(!self.begun.is_empty(), "a search has begun");
        self.spool.access(access)
    }

    /// It is whole.
    pub(super) fn end(&mut self) -> io::Result<()> {
        self.spool.search_end()
    }

    /// Lets the batches fly, one a lane, and forgets them.
    pub(super) fn play<S: LaneSink>(&mut self, listener: &mut Listener<S>) -> io::Result<()> {
        let end = self.spool.mark();
        self.spool.flush()?;
        let ends = self.begun.iter().skip(1).map(|(from, _)| *from).chain([end]);
        let lanes =
            self.begun.iter().zip(ends).map(|(&(from, origin), to)| Some((self.spool.cursor(from, to), origin)));
        fly(lanes.collect(), listener)?;
        self.begun.clear();
        self.spool.clear()
    }
}
