//! Lanes that each take the next search of the stream.

use std::{collections::VecDeque, mem};

use pm_formats::trace::Access;

use super::{LaneSink, Listener, Origin};

/// Searches in flight, and those that no lane has taken.
pub(super) struct Stream {
    /// What each lane is at.
    flying: Vec<Option<Search>>,
    /// The lane whose turn it is.
    turn: usize,
    /// Whole searches that no lane has taken.
    queue: VecDeque<Search>,
    /// The search that comes in.
    coming: Option<Search>,
}

/// A search, and how far its lane is.
#[derive(Default)]
struct Search {
    origin: Origin,
    destinations: Vec<u32>,
    accesses: Vec<Access>,
    next: usize,
}

impl Stream {
    pub(super) fn new(lanes: usize) -> Self {
        Self { flying: (0..lanes).map(|_| None).collect(), turn: 0, queue: VecDeque::new(), coming: None }
    }

    /// A search comes in.
    pub(super) fn begin(&mut self, origin: Origin, destinations: &[u32]) {
        self.coming = Some(Search { origin, destinations: destinations.to_vec(), ..Search::default() });
    }

    /// An access of it.
    #[inline]
    pub(super) fn access(&mut self, access: Access) {
        self.coming.as_mut().expect("a search has begun").accesses.push(access);
    }

    /// It is whole.
    pub(super) fn end(&mut self) {
        self.queue.extend(mem::take(&mut self.coming));
    }

    /// Turns of the lanes until one needs a search that has not come, or, at the end, until there is none left.
    pub(super) fn fly<S: LaneSink>(&mut self, ended: bool, listener: &mut Listener<S>) {
        let lanes = self.flying.len();
        let mut idle = 0;
        while idle < lanes {
            let number = self.turn;
            let lane = &mut self.flying[number];
            while lane.is_none() {
                match self.queue.pop_front() {
                    Some(search) => {
                        listener.at(number, search.origin).search(&search.destinations);
                        if search.accesses.is_empty() {
                            listener.sink.search_end();
                        } else {
                            *lane = Some(search);
                        }
                    }
                    None if ended => break,
                    None => return,
                }
            }
            idle += 1;
            if let Some(search) = lane {
                idle = 0;
                listener.at(number, search.origin).access(search.accesses[search.next]);
                search.next += 1;
                if search.next == search.accesses.len() {
                    listener.sink.search_end();
                    *lane = None;
                }
            }
            self.turn = (self.turn + 1) % lanes;
        }
    }
}
