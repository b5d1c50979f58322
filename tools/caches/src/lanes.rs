//! Several searches in flight at a time over one cache, as a machine has them that hides the latency of one search behind
//! the work of others.
//!
//! The lanes take turns, one access each. The order within a search is kept; a lane whose search is over begins its next
//! one on its next turn. With one lane nothing changes.

mod batches;
mod parts;
mod stream;
#[cfg(test)]
mod tests;

use std::io;

use pm_formats::trace::{Access, TraceSink};

use batches::Batches;
use parts::Parts;
use stream::Stream;

pm_registry::choices! {
    /// Where a lane takes its searches from.
    #[derive(Debug)]
    pub enum LaneSource {
        /// The next search of the stream, whatever its batch: neighbours in the order fly together
        Stream = "stream",
        /// A part of the batch of its own, all parts consecutive and of the same number of searches
        Parts = "parts",
        /// A batch of its own, such as a tile: as many as there are lanes, and when all are over as many again
        Batches = "batches",
    }
}

/// Who listens to lanes.
pub trait LaneSink: TraceSink {
    /// What follows, [`block`](TraceSink::block) excepted, is of the search of this lane.
    fn lane(&mut self, lane: usize) {
        let _ = lane;
    }
}

/// Lets searches fly together on their way to a simulation, or to any other sink.
///
/// What the sink hears is interleaved: with more than one lane, an access need not belong to the search that began last,
/// and [`block`](TraceSink::block) comes whenever the batch or the warm-up of what follows is another. Memory is bounded by
/// the lanes' own searches and one more; from parts a batch waits in a temporary file, and so do the batches of all lanes.
pub struct Lanes<S> {
    listener: Listener<S>,
    lanes: usize,
    /// Where what is being replayed comes from.
    origin: Origin,
    waiting: Waiting,
    /// What went wrong with the temporary file.
    fault: Option<io::Error>,
}

/// The block that a search comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Origin {
    batch: u64,
    warm_up: bool,
}

/// Searches that are not over.
enum Waiting {
    Stream(Stream),
    Parts(Parts),
    Batches(Batches),
}

/// A sink, and the block it was told of last.
struct Listener<S> {
    sink: S,
    told: Option<Origin>,
}

impl<S: LaneSink> Listener<S> {
    /// Says to which lane the next event belongs, and to which block, if it is another. Returns the sink, for the event.
    #[inline]
    fn at(&mut self, lane: usize, origin: Origin) -> &mut S {
        self.sink.lane(lane);
        if self.told != Some(origin) {
            self.told = Some(origin);
            self.sink.block(origin.batch, origin.warm_up);
        }
        &mut self.sink
    }
}

impl<S: LaneSink> Lanes<S> {
    /// `lanes` searches at a time, at least one.
    ///
    /// # Errors
    /// If a temporary file is needed and cannot be made.
    pub fn new(sink: S, lanes: u16, source: LaneSource) -> io::Result<Self> {
        let lanes = usize::from(lanes.max(1));
        let waiting = match source {
            LaneSource::Stream => Waiting::Stream(Stream::new(lanes)),
            LaneSource::Parts => Waiting::Parts(Parts::new()?),
            LaneSource::Batches => Waiting::Batches(Batches::new()?),
        };
        let listener = Listener { sink, told: None };
        Ok(Self { listener, lanes, origin: Origin::default(), waiting, fault: None })
    }

    /// Lets the last searches land, and gives back the sink.
    ///
    /// # Errors
    /// What went wrong with the temporary file, now or earlier.
    pub fn finish(mut self) -> io::Result<S> {
        if let Waiting::Stream(stream) = &mut self.waiting {
            stream.fly(true, &mut self.listener);
        }
        self.play_batch();
        if let Waiting::Batches(batches) = &mut self.waiting
            && self.fault.is_none()
        {
            self.fault = batches.play(&mut self.listener).err();
        }
        self.fault.map_or(Ok(self.listener.sink), Err)
    }

    /// The batch that waits, in as many parts as there are lanes.
    fn play_batch(&mut self) {
        if let Waiting::Parts(parts) = &mut self.waiting
            && self.fault.is_none()
        {
            self.fault = parts.play(self.lanes, self.origin, &mut self.listener).err();
        }
    }
}

impl<S: LaneSink> TraceSink for Lanes<S> {
    fn block(&mut self, batch: u64, warm_up: bool) {
        if batch != self.origin.batch {
            self.play_batch();
        }
        self.origin = Origin { batch, warm_up };
    }

    fn search(&mut self, destinations: &[u32]) {
        match &mut self.waiting {
            Waiting::Stream(stream) => stream.begin(self.origin, destinations),
            Waiting::Parts(parts) => {
                if let Err(error) = parts.begin(self.origin, destinations) {
                    self.fault.get_or_insert(error);
                }
            }
            Waiting::Batches(batches) => {
                if let Err(error) = batches.begin(self.origin, destinations, self.lanes, &mut self.listener) {
                    self.fault.get_or_insert(error);
                }
            }
        }
    }

    /// # Panics
    /// If no search has begun: whose turn would it be?
    #[inline]
    fn access(&mut self, access: Access) {
        match &mut self.waiting {
            Waiting::Stream(stream) => stream.access(access),
            Waiting::Parts(parts) => {
                if let Err(error) = parts.access(access) {
                    self.fault.get_or_insert(error);
                }
            }
            Waiting::Batches(batches) => {
                if let Err(error) = batches.access(access) {
                    self.fault.get_or_insert(error);
                }
            }
        }
    }

    fn search_end(&mut self) {
        match &mut self.waiting {
            Waiting::Stream(stream) => {
                stream.end();
                stream.fly(false, &mut self.listener);
            }
            Waiting::Parts(parts) => {
                if let Err(error) = parts.end() {
                    self.fault.get_or_insert(error);
                }
            }
            Waiting::Batches(batches) => {
                if let Err(error) = batches.end() {
                    self.fault.get_or_insert(error);
                }
            }
        }
    }
}
