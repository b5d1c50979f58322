//! Do accesses come as in the naive model?

use std::collections::VecDeque;

use proptest::prelude::*;

use super::*;

/// Batch, warm-up, destinations, addresses.
type Plain = (u64, bool, Vec<u32>, Vec<u64>);

#[derive(Clone, Debug, PartialEq)]
enum Heard {
    Search(Origin, Vec<u32>),
    Access(usize, Origin, u64),
    End,
}

#[derive(Default)]
struct Ear(Origin, Vec<Heard>, usize);

impl LaneSink for Ear {
    fn lane(&mut self, lane: usize) {
        self.2 = lane;
    }
}

impl TraceSink for Ear {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.0 = Origin { batch, warm_up };
    }
    fn search(&mut self, destinations: &[u32]) {
        self.1.push(Heard::Search(self.0, destinations.to_vec()));
    }
    fn access(&mut self, access: Access) {
        self.1.push(Heard::Access(self.2, self.0, access.offset));
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
fn model(searches: &[Plain], lanes: usize, source: LaneSource) -> Vec<(usize, Origin, u64)> {
    let batches: Vec<&[Plain]> = match source {
        LaneSource::Stream => vec![searches],
        LaneSource::Parts | LaneSource::Batches => searches.chunk_by(|a, b| a.0 == b.0).collect(),
    };
    let mut order = vec![];
    // Batches that fly together, each with the lane it is all of; or one, of all lanes.
    let together = if source == LaneSource::Batches { lanes } else { 1 };
    for batches in batches.chunks(together) {
        // Searches that no lane has, first to last; or those of each lane.
        let mut shared: VecDeque<Vec<(Origin, u64)>> = VecDeque::new();
        let mut own: Vec<VecDeque<Vec<(Origin, u64)>>> = vec![VecDeque::new(); lanes];
        let numbered =
            batches.iter().enumerate().flat_map(|(at, batch)| batch.iter().enumerate().map(move |it| (at, it)));
        for (at, (i, (batch_number, warm_up, _, accesses))) in numbered {
            let origin = Origin { batch: *batch_number, warm_up: *warm_up };
            let accesses = accesses.iter().map(|&offset| (origin, offset)).collect();
            match source {
                LaneSource::Stream => shared.push_back(accesses),
                LaneSource::Parts => {
                    let lane = (0..lanes).find(|lane| (lane + 1) * batches[0].len() / lanes > i).unwrap();
                    own[lane].push_back(accesses);
                }
                LaneSource::Batches => own[at].push_back(accesses),
            }
        }
        let mut at: Vec<VecDeque<(Origin, u64)>> = vec![VecDeque::new(); lanes];
        loop {
            let before = order.len();
            for lane in 0..lanes {
                while at[lane].is_empty() {
                    let Some(next) = own[lane].pop_front().or_else(|| shared.pop_front()) else { break };
                    at[lane] = next.into();
                }
                order.extend(at[lane].pop_front().map(|(origin, address)| (lane, origin, address)));
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
        for source in [LaneSource::Stream, LaneSource::Parts, LaneSource::Batches] {
            let heard = heard(&searches, lanes, source);
            let accesses: Vec<_> = heard.iter().filter_map(|event| match event {
                Heard::Access(lane, origin, address) => Some((*lane, *origin, *address)),
                _ => None,
            }).collect();
            prop_assert_eq!(accesses, model(&searches, lanes.into(), source));
            // Every search is heard of once, with its own origin.
            let begun = |wanted: &Plain| heard.iter().filter(|event| {
                **event == Heard::Search(Origin { batch: wanted.0, warm_up: wanted.1 }, wanted.2.clone())
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
        for source in [LaneSource::Stream, LaneSource::Parts, LaneSource::Batches] {
            prop_assert_eq!(&heard(&searches, 1, source), &plain.1);
        }
    }
}
