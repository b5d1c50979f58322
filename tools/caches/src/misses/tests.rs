//! Are misses told as plain caches have them?

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceReader, TraceSink, lay_out};
use pm_formats::{BlockMeta, Header};

use crate::plain_lru::{batch, findings, naive_fetches, oracle};
use crate::trial::{Draw, Event, random_events, random_regions, replay};
use crate::{CacheConfig, Findings, Measures, MissStream, Simulation, Ways};

#[test]
fn pages_change_as_in_a_list_of_fetches() {
    let mut draw = Draw::new(22);
    for case in 0..600 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let line = draw.pick(&[16_u32, 128, 16_384]);
        let page = draw.pick(&[64_u64, 4096, 8192]);
        let sizes = [(2, Ways::Full), (7, Ways::Full), (8, Ways::N(2.try_into().unwrap()))];
        let configs = sizes.map(|(lines, ways)| CacheConfig::lru(lines * u64::from(line), ways, line).unwrap());
        let chunk = draw.pick(&[1, 60, 2048]);
        let measures = Measures { page_bytes: Some(page), split: true, ..Measures::default() };
        let all = [&configs[..], &[CacheConfig::none(line).unwrap()]].concat();
        let rows = findings(&regions, &all, &measures, &events, chunk).caches;
        // First and last byte of each fetch, and whether it counts.
        let fetches = |config: CacheConfig| -> Vec<(u64, u64, bool)> {
            if !config.keeps_lines() {
                let mut counted = true;
                let reads = events.iter().filter_map(|event| match event {
                    Event::Block { warm_up } => {
                        counted = !warm_up;
                        None
                    }
                    Event::Access(access) if access.kind != AccessKind::Write => {
                        let first = regions[access.region as usize].base + access.offset;
                        Some((first, first + u64::from(access.len.max(1)) - 1, counted))
                    }
                    _ => None,
                });
                return reads.collect();
            }
            let lines = naive_fetches(&regions, config, &events).into_iter();
            let line = u64::from(line);
            lines.map(|(_, number, counted, _)| (number * line, number * line + line - 1, counted)).collect()
        };
        for (row, &config) in rows.iter().zip(&all) {
            let (mut open, mut switches) = (None, 0);
            for (first, last, counted) in fetches(config) {
                for page in first / page..=last / page {
                    switches += u64::from(counted && open.is_some_and(|open| open != page));
                    open = Some(page);
                }
            }
            // A counted fetch of several pages that is the first of all has changes inside only: the same in the loop.
            assert_eq!(row.more.page_switches, Some(switches), "case {case}: {config}, pages of {page}");
        }
    }
}

/// Runs a trace through a miss stream: its header and what it replays.
fn missed(regions: &[Region], config: CacheConfig, events: &[Event]) -> (Header, Vec<Event>, Findings) {
    let header = Header { regions: regions.to_vec(), ..Header::empty() };
    let mut stream =
        MissStream::new(Vec::new(), header, config, &Measures { split: true, ..Measures::default() }).unwrap();
    let mut blocks = 0;
    let mut meta = BlockMeta { batch: batch(0), warm_up: false, records: 0 };
    stream.block(meta.batch, meta.warm_up);
    let mut open = false;
    for event in events {
        if open && !matches!(event, Event::Access(_)) {
            stream.search_end();
            open = false;
        }
        match event {
            Event::Block { warm_up } => {
                stream.end_block(meta).unwrap();
                blocks += 1;
                meta = BlockMeta { batch: batch(blocks), warm_up: *warm_up, records: 0 };
                stream.block(meta.batch, meta.warm_up);
            }
            Event::Search(destinations) => {
                stream.search(destinations);
                open = true;
            }
            // Accesses belong to searches, in a trace.
            Event::Access(access) if open => stream.access(*access),
            Event::Access(_) => {}
        }
    }
    if open {
        stream.search_end();
    }
    stream.end_block(meta).unwrap();
    let (bytes, findings) = stream.finish(|_| vec![]).unwrap();
    struct Listen(Vec<Event>);
    impl TraceSink for Listen {
        fn block(&mut self, _: u64, warm_up: bool) {
            self.0.push(Event::Block { warm_up });
        }
        fn search(&mut self, destinations: &[u32]) {
            self.0.push(Event::Search(destinations.to_vec()));
        }
        fn access(&mut self, access: Access) {
            self.0.push(Event::Access(access));
        }
    }
    let mut reader = TraceReader::new(&bytes[..]).unwrap();
    let mut listen = Listen(vec![]);
    let mut seen = 0;
    while let Some(meta) = reader.replay_block(&mut listen).unwrap() {
        assert_eq!(meta.batch, batch(seen));
        seen += 1;
    }
    assert_eq!(seen, blocks + 1);
    (reader.header().clone(), listen.0, findings)
}

/// Leaves out accesses that no search makes, and says the first block aloud.
fn within_searches(events: Vec<Event>) -> Vec<Event> {
    let mut open = false;
    let mut kept = vec![Event::Block { warm_up: false }];
    kept.extend(events.into_iter().filter(|event| {
        open = match event {
            Event::Block { .. } => false,
            Event::Search(_) => true,
            Event::Access(_) => open,
        };
        open || !matches!(event, Event::Access(_))
    }));
    kept
}

#[test]
fn chained_caches_are_two_levels() {
    let mut draw = Draw::new(26);
    let mut fetched = 0;
    for case in 0..500 {
        let mut regions = random_regions(&mut draw);
        // Regions of a trace do not share pages and begin on one.
        regions.iter_mut().for_each(|region| region.base = region.base.next_multiple_of(4096));
        let events = within_searches(random_events(&mut draw, &regions));
        let first: CacheConfig =
            draw.pick(&["512,2,64,lru", "1K,full,64,lru", "256,1,16,lru", "64K,full,16K,lru"]).parse().unwrap();
        let second: CacheConfig = draw.pick(&["2K,full,64,lru", "4K,4,128,lru", "1K,full,32,lru"]).parse().unwrap();
        let (header, stream, found) = missed(&regions, first, &events[1..]);

        // The first level, plainly: each event with the reads it lets through.
        let misses = naive_fetches(&regions, first, &events);
        let mut expected = vec![];
        for (i, event) in events.iter().enumerate() {
            if !matches!(event, Event::Access(_)) {
                expected.push(event.clone());
            }
            for &(region, line, ..) in misses.iter().filter(|miss| miss.3 == i) {
                let (size, base) = (u64::from(first.line_bytes()), regions[region as usize].base);
                let end = base + header.regions[region as usize].size;
                let (from, to) = ((line * size).max(base), ((line + 1) * size).min(end));
                expected.push(Event::Access(Access::read(region, from - base, (to - from) as u32)));
            }
        }
        assert_eq!(format!("{stream:?}"), format!("{expected:?}"), "case {case}: {first}");
        assert_eq!(found.caches[0].fetches, oracle(&regions, first, &events).fetches);

        // And the second, on what comes through.
        let mut simulation = Simulation::new(&header.regions, &[second]).unwrap();
        replay(&stream, &mut simulation);
        assert_eq!(
            simulation.finish()[0],
            oracle(&header.regions, second, &expected),
            "case {case}: {first}, {second}"
        );
        fetched += misses.len();
        if first.line_bytes() <= 4096 {
            let whole = header.regions.iter().zip(&regions);
            assert!(
                whole
                    .into_iter()
                    .all(|(now, before)| now.size == before.size.next_multiple_of(first.line_bytes().into()))
            );
        }
    }
    assert!(fetched > 10_000, "{fetched} fetches are no test");
}

#[test]
fn a_long_block_is_written_as_several() {
    // More misses than go into a block, in searches of their own.
    let regions = lay_out([("a".to_owned(), 1 << 30, 64, Coding::Records)]);
    let mut events = vec![];
    for search in 0..3_u64 {
        events.push(Event::Search(vec![search as u32]));
        events.extend((0..700_000).map(|i| Event::Access(Access::read(0, (search * 700_000 + i) * 64, 64))));
    }
    let header = Header { regions: regions.clone(), ..Header::empty() };
    let config = "1K,full,64,lru".parse().unwrap();
    let mut stream = MissStream::new(Vec::new(), header, config, &Measures::default()).unwrap();
    let meta = BlockMeta { batch: 7, warm_up: true, records: 3 };
    stream.block(meta.batch, meta.warm_up);
    for event in &events {
        match event {
            Event::Search(destinations) => stream.search(destinations),
            Event::Access(access) => stream.access(*access),
            Event::Block { .. } => {}
        }
        if matches!(event, Event::Access(access) if (access.offset / 64 + 1).is_multiple_of(700_000)) {
            stream.search_end();
        }
    }
    stream.end_block(meta).unwrap();
    let (bytes, _) = stream.finish(|_| vec![]).unwrap();
    let mut reader = TraceReader::new(&bytes[..]).unwrap();
    let mut second = Simulation::new(&regions, &["1K,full,64,lru".parse().unwrap()]).unwrap();
    let mut metas = vec![];
    while let Some(meta) = reader.replay_block(&mut second).unwrap() {
        metas.push((meta.batch, meta.warm_up, meta.records));
    }
    assert_eq!(metas, [(7, true, 2), (7, true, 1)]);
    assert_eq!(reader.tally().records, 3);
}
