//! Several searches in flight at a time over one cache, as a machine has them that hides the latency of one search behind
//! the work of others.
//!
//! The lanes take turns, one access each. The order within a search is kept; a lane whose search is over begins its next
//! one on its next turn. With one lane nothing changes.

use std::{collections::VecDeque, io, mem};

use pm_formats::trace::{Access, TraceSink};

use pm_spool::{Cursor, Event, Spool};

pm_registry::choices! {
    /// Where a lane takes its searches from.
    #[derive(Debug)]
    pub enum LaneSource {
        /// The next search of the stream, whatever its batch: neighbours in the order fly together
        Stream = "stream",
        /// A part of the batch of its own, all parts consecutive and of the same number of searches
        Parts = "parts",
    }
}

/// Lets searches fly together on their way to a simulation, or to any other sink.
///
/// What the sink hears is interleaved: with more than one lane, an access need not belong to the search that began last,
/// and [`block`](TraceSink::block) comes whenever the batch or the warm-up of what follows is another. Memory is bounded by
/// the lanes' own searches and one more; from parts, a batch waits in a temporary file.
pub struct Lanes<S> {
    sink: S,
    lanes: usize,
    /// What is being replayed.
    place: Place,
    /// What the sink was told last.
    told: Option<Place>,
    waiting: Waiting,
    /// What went wrong with the temporary file.
    fault: Option<io::Error>,
}

/// Block that a search belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Place {
    batch: u64,
    warm_up: bool,
}

/// Searches that are not over.
enum Waiting {
    /// From the stream.
    Stream {
        /// What each lane is at.
        flying: Vec<Option<Search>>,
        /// The lane whose turn it is.
        turn: usize,
        /// Whole searches that no lane has taken.
        queue: VecDeque<Search>,
        /// The search that comes in.
        coming: Option<Search>,
    },
    /// From parts of a batch: the batch, and where each search begins in it.
    Parts { spool: Spool, starts: Vec<u64> },
}

/// A search, and how far its lane is.
#[derive(Default)]
struct Search {
    place: Place,
    destinations: Vec<u32>,
    accesses: Vec<Access>,
    next: usize,
}

impl<S: TraceSink> Lanes<S> {
    /// `lanes` searches at a time, at least one.
    ///
    /// # Errors
    /// If a temporary file is needed and cannot be made.
    pub fn new(sink: S, lanes: u16, source: LaneSource) -> io::Result<Self> {
        let lanes = usize::from(lanes.max(1));
        let waiting = match source {
            LaneSource::Stream => Waiting::Stream {
                flying: (0..lanes).map(|_| None).collect(),
                turn: 0,
                queue: VecDeque::new(),
                coming: None,
            },
            LaneSource::Parts => Waiting::Parts { spool: Spool::new()?, starts: vec![] },
        };
        Ok(Self { sink, lanes, place: Place::default(), told: None, waiting, fault: None })
    }

    /// Lets the last searches land, and gives back the sink.
    ///
    /// # Errors
    /// What went wrong with the temporary file, now or earlier.
    pub fn finish(mut self) -> io::Result<S> {
        self.fly(true);
        self.play_batch();
        self.fault.map_or(Ok(self.sink), Err)
    }

    /// Turns of the lanes until one needs a search that has not come, or, at the end, until there is none left.
    fn fly(&mut self, ended: bool) {
        let Waiting::Stream { flying, turn, queue, .. } = &mut self.waiting else { return };
        let mut idle = 0;
        while idle < self.lanes {
            while flying[*turn].is_none() {
                match queue.pop_front() {
                    Some(search) => {
                        tell(&mut self.sink, &mut self.told, search.place);
                        self.sink.search(&search.destinations);
                        if search.accesses.is_empty() {
                            self.sink.search_end();
                        } else {
                            flying[*turn] = Some(search);
                        }
                    }
                    None if ended => break,
                    None => return,
                }
            }
            idle += 1;
            if let Some(search) = &mut flying[*turn] {
                idle = 0;
                tell(&mut self.sink, &mut self.told, search.place);
                self.sink.access(search.accesses[search.next]);
                search.next += 1;
                if search.next == search.accesses.len() {
                    self.sink.search_end();
                    flying[*turn] = None;
                }
            }
            *turn = (*turn + 1) % self.lanes;
        }
    }

    /// The batch that waits, in as many parts as there are lanes.
    fn play_batch(&mut self) {
        if let Err(error) = self.try_play_batch() {
            self.fault.get_or_insert(error);
        }
    }

    fn try_play_batch(&mut self) -> io::Result<()> {
        let Waiting::Parts { spool, starts } = &mut self.waiting else { return Ok(()) };
        if starts.is_empty() || self.fault.is_some() {
            return Ok(());
        }
        let searches = starts.len();
        starts.push(spool.mark());
        spool.flush()?;
        let first = |part: usize| starts[(part as u128 * searches as u128 / self.lanes as u128) as usize];
        let mut parts: Vec<Option<(Cursor, Place)>> =
            (0..self.lanes).map(|i| Some((spool.cursor(first(i), first(i + 1)), self.place))).collect();
        while parts.iter().any(Option::is_some) {
            for part in &mut parts {
                let Some((cursor, place)) = part else { continue };
                if !turn(cursor, place, &mut self.sink, &mut self.told)? {
                    *part = None;
                }
            }
        }
        drop(parts);
        starts.clear();
        spool.clear()
    }
}

/// One access of a part; false if it has none left.
fn turn(
    cursor: &mut Cursor,
    place: &mut Place,
    sink: &mut impl TraceSink,
    told: &mut Option<Place>,
) -> io::Result<bool> {
    while let Some(event) = cursor.next_event()? {
        match event {
            Event::Search { warm_up, destinations } => {
                place.warm_up = warm_up;
                tell(sink, told, *place);
                sink.search(&destinations);
            }
            Event::Access(access) => {
                tell(sink, told, *place);
                sink.access(access);
                return Ok(true);
            }
            Event::SearchEnd => sink.search_end(),
        }
    }
    Ok(false)
}

/// Says to which block the next event belongs, if it is another.
#[inline]
fn tell(sink: &mut impl TraceSink, told: &mut Option<Place>, place: Place) {
    if *told != Some(place) {
        *told = Some(place);
        sink.block(place.batch, place.warm_up);
    }
}

impl<S: TraceSink> TraceSink for Lanes<S> {
    fn block(&mut self, batch: u64, warm_up: bool) {
        if batch != self.place.batch {
            self.play_batch();
        }
        self.place = Place { batch, warm_up };
    }

    fn search(&mut self, destinations: &[u32]) {
        match &mut self.waiting {
            Waiting::Stream { coming, .. } => {
                *coming = Some(Search { place: self.place, destinations: destinations.to_vec(), ..Search::default() });
            }
            Waiting::Parts { spool, starts } => {
                starts.push(spool.mark());
                if let Err(error) = spool.search(self.place.warm_up, destinations) {
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
            Waiting::Stream { coming, .. } => coming.as_mut().expect("a search has begun").accesses.push(access),
            Waiting::Parts { spool, starts } => {
                assert!(!starts.is_empty(), "a search has begun");
                if let Err(error) = spool.access(access) {
                    self.fault.get_or_insert(error);
                }
            }
        }
    }

    fn search_end(&mut self) {
        match &mut self.waiting {
            Waiting::Stream { queue, coming, .. } => {
                queue.extend(mem::take(coming));
                self.fly(false);
            }
            Waiting::Parts { spool, .. } => {
                if let Err(error) = spool.search_end() {
                    self.fault.get_or_insert(error);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Batch, warm-up, destinations, addresses.
    type Plain = (u64, bool, Vec<u32>, Vec<u64>);

    #[derive(Clone, Debug, PartialEq)]
    enum Heard {
        Search(Place, Vec<u32>),
        Access(Place, u64),
        End,
    }

    #[derive(Default)]
    struct Ear(Place, Vec<Heard>);

    impl TraceSink for Ear {
        fn block(&mut self, batch: u64, warm_up: bool) {
            self.0 = Place { batch, warm_up };
        }
        fn search(&mut self, destinations: &[u32]) {
            self.1.push(Heard::Search(self.0, destinations.to_vec()));
        }
        fn access(&mut self, access: Access) {
            self.1.push(Heard::Access(self.0, access.offset));
        }
        fn search_end(&mut self) {
            self.1.push(Heard::End);
        }
    }

    fn heard(searches: &[Plain], lanes: u16, source: LaneSource) -> Vec<Heard> {
        let mut sink = Lanes::new(Ear::default(), lanes, source).unwrap();
        for (batch, warm_up, destinations, accesses) in searches {
            sink.block(*batch, *warm_up);
            sink.search(destinations);
            accesses.iter().for_each(|&offset| sink.access(Access::read(0, offset, 20)));
            sink.search_end();
        }
        sink.finish().unwrap().1
    }

    /// The naive model: all searches are there, a lane is a list of those it will have.
    fn model(searches: &[Plain], lanes: usize, source: LaneSource) -> Vec<(Place, u64)> {
        let batches: Vec<&[Plain]> = match source {
            LaneSource::Stream => vec![searches],
            LaneSource::Parts => searches.chunk_by(|a, b| a.0 == b.0).collect(),
        };
        let mut order = vec![];
        for batch in batches {
            // Searches that no lane has, first to last; or those of each lane.
            let mut shared: VecDeque<Vec<(Place, u64)>> = VecDeque::new();
            let mut own: Vec<VecDeque<Vec<(Place, u64)>>> = vec![VecDeque::new(); lanes];
            for (i, (batch_number, warm_up, _, accesses)) in batch.iter().enumerate() {
                let place = Place { batch: *batch_number, warm_up: *warm_up };
                let accesses = accesses.iter().map(|&offset| (place, offset)).collect();
                match source {
                    LaneSource::Stream => shared.push_back(accesses),
                    LaneSource::Parts => {
                        let lane = (0..lanes).find(|lane| (lane + 1) * batch.len() / lanes > i).unwrap();
                        own[lane].push_back(accesses);
                    }
                }
            }
            let mut at: Vec<VecDeque<(Place, u64)>> = vec![VecDeque::new(); lanes];
            loop {
                let before = order.len();
                for lane in 0..lanes {
                    while at[lane].is_empty() {
                        let Some(next) = own[lane].pop_front().or_else(|| shared.pop_front()) else { break };
                        at[lane] = next.into();
                    }
                    order.extend(at[lane].pop_front());
                }
                if order.len() == before {
                    break;
                }
            }
        }
        order
    }

    fn any_searches() -> impl Strategy<Value = Vec<Plain>> {
        let lengths = prop_oneof![0usize..4, 0usize..40];
        let search = (any::<bool>(), prop::collection::vec(any::<u32>(), 0..3), lengths, prop::bool::weighted(0.2));
        prop::collection::vec(search, 0..30).prop_map(|searches| {
            let (mut batch, mut address) = (0, 0);
            let plain = |(warm_up, destinations, length, begins): (bool, Vec<u32>, usize, bool)| {
                batch += u64::from(begins);
                address += 1000;
                (batch, warm_up, destinations, (address..address + length as u64).collect())
            };
            searches.into_iter().map(plain).collect()
        })
    }

    proptest! {
        #[test]
        fn accesses_come_as_in_the_naive_model(searches in any_searches(), lanes in 1u16..9) {
            for source in [LaneSource::Stream, LaneSource::Parts] {
                let heard = heard(&searches, lanes, source);
                let accesses: Vec<_> = heard.iter().filter_map(|event| match event {
                    Heard::Access(place, address) => Some((*place, *address)),
                    _ => None,
                }).collect();
                prop_assert_eq!(accesses, model(&searches, lanes.into(), source));
                // Every search is heard of once, in its own place.
                let begun = |wanted: &Plain| heard.iter().filter(|event| {
                    **event == Heard::Search(Place { batch: wanted.0, warm_up: wanted.1 }, wanted.2.clone())
                }).count();
                let same = |wanted: &Plain| {
                    searches.iter().filter(|other| (other.0, other.1, &other.2) == (wanted.0, wanted.1, &wanted.2)).count()
                };
                prop_assert!(searches.iter().all(|search| begun(search) == same(search)));
                prop_assert_eq!(heard.iter().filter(|event| **event == Heard::End).count(), searches.len());
            }
        }

        #[test]
        fn one_lane_changes_nothing(searches in any_searches()) {
            let mut plain = Ear::default();
            for (batch, warm_up, destinations, accesses) in &searches {
                plain.block(*batch, *warm_up);
                plain.search(destinations);
                accesses.iter().for_each(|&offset| plain.access(Access::read(0, offset, 20)));
                plain.search_end();
            }
            for source in [LaneSource::Stream, LaneSource::Parts] {
                prop_assert_eq!(&heard(&searches, 1, source), &plain.1);
            }
        }
    }
}
