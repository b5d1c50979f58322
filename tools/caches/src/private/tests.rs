//! Do private caches count what lists of lines by recency do, and is one element one cache?

use std::collections::{BTreeMap, BTreeSet};

use pm_formats::trace::{Access, Region, TraceSink};

use super::PrivateCaches;
use crate::trial::{Draw, Event, random_events, random_regions, replay};
use crate::{CacheConfig, LaneSink, LaneSource, Lanes, Measures, ResultMemory, Simulation, Ways};

/// A random trace in which every access is of a search.
fn random_trace(draw: &mut Draw) -> (Vec<Region>, Vec<Event>) {
    let regions = random_regions(draw);
    let events = random_events(draw, &regions);
    let first = [Event::Block { warm_up: false }, Event::Search(vec![0])];
    (regions, first.into_iter().chain(events).collect())
}

/// Replays into lanes, which want to know when a search ends, and batches of three searches each.
fn fly<S: LaneSink>(events: &[Event], sink: S, lanes: u16, source: LaneSource) -> S {
    let mut lanes = Lanes::new(sink, lanes, source).unwrap();
    let (mut searches, mut counted, mut open) = (0, true, false);
    for event in events {
        match event {
            Event::Block { warm_up } => counted = !warm_up,
            Event::Search(destinations) => {
                if open {
                    lanes.search_end();
                }
                lanes.block(searches / 3, !counted);
                lanes.search(destinations);
                (searches, open) = (searches + 1, true);
            }
            Event::Access(access) => lanes.access(*access),
        }
    }
    if open {
        lanes.search_end();
    }
    lanes.finish().unwrap()
}

const SOURCES: [LaneSource; 3] = [LaneSource::Stream, LaneSource::Parts, LaneSource::Batches];

#[test]
fn one_element_is_one_cache() {
    let mut draw = Draw::new(61);
    for case in 0..200 {
        let (regions, events) = random_trace(&mut draw);
        let configs = [
            CacheConfig::lru(640, Ways::Full, 64).unwrap(),
            "1K,4,16,plru".parse().unwrap(),
            "512,full,64,min".parse().unwrap(),
            CacheConfig::none(64).unwrap(),
        ];
        let measures = Measures {
            split: true,
            page_bytes: Some(4096),
            working_sets: true,
            results: Some(ResultMemory { cache_bytes: 64, pixel_bytes: 12, tile_pixels: None }),
            ..Measures::default()
        };
        let plain = fly(&events, Simulation::measuring(&regions, &configs, &measures).unwrap(), 1, LaneSource::Stream);
        let plain = plain.findings();
        for source in SOURCES {
            let private = PrivateCaches::new(&regions, &configs, &measures, 1, None).unwrap();
            let mut found = fly(&events, private, 1, source).findings();
            found.caches.iter_mut().for_each(|counts| {
                let private = counts.more.private.take().expect("what private caches have in common");
                assert_eq!((private.elements, private.lines_shared), (1, 0));
            });
            assert_eq!(found, plain, "case {case}, {source:?}");
        }
    }
}

/// Whose access it is, and whether it counts.
#[derive(Default)]
struct Turns(Vec<(usize, Access, bool)>, usize, bool);

impl LaneSink for Turns {
    fn lane(&mut self, lane: usize) {
        self.1 = lane;
    }
}

impl TraceSink for Turns {
    fn block(&mut self, _: u64, warm_up: bool) {
        self.2 = warm_up;
    }
    fn access(&mut self, access: Access) {
        self.0.push((self.1, access, !self.2));
    }
}

/// Is a line in a list of so many by recency? It is afterwards.
fn hits(list: &mut Vec<u64>, lines: usize, line: u64) -> bool {
    let at = list.iter().position(|&held| held == line);
    at.map(|at| list.remove(at));
    list.insert(0, line);
    list.truncate(lines);
    at.is_some()
}

#[test]
fn caches_are_lists_of_lines_and_the_shared_one_is_asked_in_turn() {
    let mut draw = Draw::new(62);
    let (mut shared_lines, mut behind_fetched) = (0, 0);
    for case in 0..400 {
        let (regions, events) = random_trace(&mut draw);
        let (elements, source) = (draw.pick(&[1, 2, 5, 9]), draw.pick(&SOURCES));
        let line = draw.pick(&[16_u64, 64]);
        let (own, behind) = (draw.pick(&[2_u64, 6]), draw.pick(&[8_u64, 40]));
        let config = |lines: u64| CacheConfig::lru(lines * line, Ways::Full, line as u32).unwrap();
        let private =
            PrivateCaches::new(&regions, &[config(own)], &Measures::default(), elements, Some(config(behind))).unwrap();
        let found = fly(&events, private, elements, source).findings().caches.remove(0);

        let mut lists = vec![vec![]; elements.into()];
        let (mut fetches, mut accesses) = (vec![0; elements.into()], vec![0; elements.into()]);
        let (mut list, mut behind_fetches) = (vec![], 0);
        let mut whose: BTreeMap<u64, BTreeSet<usize>> = BTreeMap::new();
        for (element, access, counted) in fly(&events, Turns::default(), elements, source).0 {
            accesses[element] += u64::from(counted);
            let first = regions[usize::from(access.region)].base + access.offset;
            for line in first / line..=(first + u64::from(access.len.max(1) - 1)) / line {
                if counted {
                    whose.entry(line).or_default().insert(element);
                }
                if !hits(&mut lists[element], own as usize, line) {
                    fetches[element] += u64::from(counted);
                    behind_fetches += u64::from(!hits(&mut list, behind as usize, line) && counted);
                }
            }
        }
        let what = format!("case {case}: {elements} elements, {source:?}, {own} and {behind} lines of {line}");
        assert_eq!(found.fetches, fetches.iter().sum::<u64>(), "{what}");
        let counts = found.more.private.unwrap();
        assert_eq!(counts.fetches, (*fetches.iter().max().unwrap(), found.fetches), "{what}");
        assert_eq!(counts.accesses, (*accesses.iter().max().unwrap(), accesses.iter().sum::<u64>()), "{what}");
        assert_eq!(counts.lines_shared, whose.values().filter(|who| who.len() > 1).count() as u64, "{what}");
        assert_eq!(counts.shared.unwrap().fetches, behind_fetches, "{what}");
        (shared_lines, behind_fetched) = (shared_lines + counts.lines_shared, behind_fetched + behind_fetches);
    }
    assert!(shared_lines > 1000 && behind_fetched > 10_000, "{shared_lines}, {behind_fetched} are no test");
}

#[test]
fn nothing_is_shared_behind_no_cache() {
    let (regions, none) = (random_regions(&mut Draw::new(1)), CacheConfig::none(64).unwrap());
    let behind = CacheConfig::lru(640, Ways::Full, 64).unwrap();
    assert!(PrivateCaches::new(&regions, &[none], &Measures::default(), 2, Some(behind)).is_err());
    // Many accesses: more than wait at a time.
    let mut sink = PrivateCaches::new(&regions, &[behind], &Measures::default(), 2, Some(behind)).unwrap();
    let events: Vec<Event> = (0..5000).map(|_| Event::Access(Access::read(0, 0, 1))).collect();
    replay(&[&[Event::Search(vec![0])], &events[..]].concat(), &mut sink);
    let counts = sink.findings().caches.remove(0);
    assert_eq!((counts.fetches, counts.more.private.unwrap().shared.unwrap().fetches), (1, 1));
}
