//! Cuts windows out of a stream of queries as it passes, each with the queries before it for warm-up.

use pm_formats::{BlockMeta, Query};
use pm_sampling::windows::StratifiedStream;
use std::collections::VecDeque;

/// Takes queries in order and lets those of windows go.
pub(crate) struct Cutter {
    every: StratifiedStream,
    /// Queries before a window.
    warm_up: usize,
    /// The last of those that came, at most `warm_up`.
    recent: VecDeque<Query>,
    /// Number of queries that came.
    came: u64,
    stratum: u64,
    /// Queries of windows, and those written before them.
    pub(crate) measured: u64,
    pub(crate) warm_ups: u64,
}

impl Cutter {
    pub(crate) fn new(every: StratifiedStream, warm_up: usize) -> Self {
        Self { every, warm_up, recent: VecDeque::new(), came: 0, stratum: 0, measured: 0, warm_ups: 0 }
    }

    /// Takes the next queries. What lies in a window goes to `emit`; where one begins, first the queries before it, whether
    /// or not they were part of the window before.
    pub(crate) fn cut<E>(
        &mut self,
        queries: &[Query],
        mut emit: impl FnMut(BlockMeta, &[Query]) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut rest = queries;
        while !rest.is_empty() {
            let window = self.every.window(self.stratum);
            let inside = self.came >= window.start;
            let meta = BlockMeta { batch: self.stratum, ..BlockMeta::default() };
            if self.came == window.start {
                self.warm_ups += self.recent.len() as u64;
                emit(BlockMeta { warm_up: true, ..meta }, self.recent.make_contiguous())?;
            }
            let until = if inside { window.end } else { window.start };
            let (now, later) = rest.split_at(rest.len().min(usize::try_from(until - self.came).unwrap_or(usize::MAX)));
            if inside {
                self.measured += now.len() as u64;
                emit(meta, now)?;
            }
            self.remember(now);
            self.came += now.len() as u64;
            self.stratum += u64::from(self.came == window.end);
            rest = later;
        }
        Ok(())
    }

    fn remember(&mut self, queries: &[Query]) {
        let last = &queries[queries.len().saturating_sub(self.warm_up)..];
        let room = self.warm_up - last.len();
        self.recent.drain(..self.recent.len().saturating_sub(room));
        self.recent.extend(last);
    }
}
