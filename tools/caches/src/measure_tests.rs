//! Do the measures besides the caches' own counts agree with plain models of them?

use std::collections::BTreeSet;

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceReader, TraceSink, lay_out};
use pm_formats::{BlockMeta, Header};

use super::tests::{Event, Random, oracle, random_events, random_regions};
use super::{CacheConfig, Findings, Measures, MissStream, Policy, ResultMemory, SECTOR_BYTES, Simulation, Span, Ways};

/// The batch of the i-th block: some stay, some change, some come back.
fn batch(block: u64) -> u64 {
    block * block / 3 % 3
}

fn replay(events: &[Event], sink: &mut impl TraceSink) {
    let mut blocks = 0;
    sink.block(batch(0), false);
    for event in events {
        match event {
            Event::Block { warm_up } => {
                blocks += 1;
                sink.block(batch(blocks), *warm_up);
            }
            Event::Search(destinations) => sink.search(destinations),
            Event::Access(access) => sink.access(*access),
        }
    }
}

fn findings(
    regions: &[Region],
    configs: &[CacheConfig],
    measures: &Measures,
    events: &[Event],
    chunk: usize,
) -> Findings {
    let mut simulation = Simulation::with_chunk(regions, configs, measures, chunk).unwrap();
    replay(events, &mut simulation);
    simulation.findings()
}

/// The lines that an access touches.
fn lines(regions: &[Region], access: Access, line: u64) -> std::ops::RangeInclusive<u64> {
    let first = regions[access.region as usize].base + access.offset;
    first / line..=(first + u64::from(access.len.max(1)) - 1) / line
}

/// Sets of lists, most recent first: region, line, whether counted and index of the event, of each fetch in order.
fn naive_fetches(regions: &[Region], config: CacheConfig, events: &[Event]) -> Vec<(u16, u64, bool, usize)> {
    let sets = match config.ways() {
        Ways::Full => 1,
        Ways::N(ways) => config.lines() / u64::from(ways.get()),
    };
    let mut lists = vec![Vec::new(); sets as usize];
    let (mut counted, mut fetches) = (true, vec![]);
    for (i, event) in events.iter().enumerate() {
        match event {
            Event::Block { warm_up } => counted = !warm_up,
            Event::Search(_) => {}
            Event::Access(access) => {
                for line in lines(regions, *access, config.line_bytes().into()) {
                    let list = &mut lists[(line % sets) as usize];
                    match list.iter().position(|&known| known == line) {
                        Some(at) => drop(list.remove(at)),
                        None => fetches.push((access.region, line, counted, i)),
                    }
                    list.insert(0, line);
                    list.truncate((config.lines() / sets) as usize);
                }
            }
        }
    }
    fetches
}

#[test]
fn working_sets_are_sets() {
    let mut random = Random(21);
    let mut batches = 0;
    for case in 0..600 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let chunk = random.pick(&[1, 5, 60, 2048]);
        let measures = Measures { working_sets: true, ..Measures::default() };
        let row = findings(&regions, &["1K,full,32,lru".parse().unwrap()], &measures, &events, chunk).rows.remove(0);
        let found = row.more.working_sets.unwrap();

        let (mut counted, mut blocks, mut open) = (true, 0, None);
        let (mut searches, mut in_batches): (Vec<BTreeSet<u64>>, Vec<BTreeSet<u64>>) = (vec![], vec![]);
        for event in &events {
            match event {
                Event::Block { warm_up } => {
                    counted = !warm_up;
                    blocks += 1;
                }
                Event::Search(_) if counted => {
                    searches.push(BTreeSet::new());
                    if open != Some(batch(blocks)) {
                        open = Some(batch(blocks));
                        in_batches.push(BTreeSet::new());
                    }
                }
                Event::Access(access) if counted && !searches.is_empty() => {
                    searches.last_mut().unwrap().extend(lines(&regions, *access, 32));
                    in_batches.last_mut().unwrap().extend(lines(&regions, *access, 32));
                }
                _ => {}
            }
        }
        for (sets, distribution) in [(&searches, &found.per_search), (&in_batches, &found.per_batch)] {
            let mut counts: Vec<u32> = sets.iter().map(|set| set.len() as u32).collect();
            counts.sort_unstable();
            assert_eq!(distribution.number(), counts.len() as u64, "case {case}");
            assert_eq!(distribution.sum(), counts.iter().map(|&n| u64::from(n)).sum::<u64>(), "case {case}");
            assert_eq!(distribution.max(), counts.last().copied());
            let rank = |percent: usize| counts.get((counts.len() * percent).div_ceil(100).max(1) - 1).copied();
            assert_eq!([50, 90].map(|p| distribution.percentile(p)), [50, 90].map(rank), "case {case}");
        }
        batches += in_batches.len();
    }
    assert!(batches > 1500, "{batches} batches are no test");
}

#[test]
fn pages_change_as_in_a_list_of_fetches() {
    let mut random = Random(22);
    for case in 0..600 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let line = random.pick(&[16_u32, 128, 16_384]);
        let page = random.pick(&[64_u64, 4096, 8192]);
        let sizes = [(2, Ways::Full), (7, Ways::Full), (8, Ways::N(2.try_into().unwrap()))];
        let configs = sizes.map(|(lines, ways)| CacheConfig::lru(lines * u64::from(line), ways, line).unwrap());
        let chunk = random.pick(&[1, 60, 2048]);
        let measures = Measures { page_bytes: Some(page), split: true, ..Measures::default() };
        let all = [&configs[..], &[CacheConfig::none(line).unwrap()]].concat();
        let rows = findings(&regions, &all, &measures, &events, chunk).rows;
        // First and last byte of each fetch, and whether it counts.
        let fetches = |config: CacheConfig| -> Vec<(u64, u64, bool)> {
            if config.policy() == Policy::None {
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

#[test]
fn misses_are_compulsory_capacity_and_conflict() {
    let mut random = Random(23);
    let (mut conflicts, mut anti) = (0, 0);
    for _ in 0..400 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let configs = ["256,2,64,lru", "none,64", "256,full,64,lru", "128,1,64,lru", "256,1,16,lru", "256,2,64,lru"]
            .map(|text| text.parse().unwrap());
        let rows = findings(&regions, &configs, &Measures { split: true, ..Measures::default() }, &events, 2048).rows;
        assert!(rows.iter().map(|row| row.config).eq(configs), "twins are not shown");
        for row in &rows {
            if row.config.policy() == Policy::None {
                assert_eq!((row.capacity(), row.conflict()), (None, None));
                continue;
            }
            let twin = CacheConfig::lru(row.config.size_bytes(), Ways::Full, row.config.line_bytes()).unwrap();
            let mut counted = true;
            let full = naive_fetches(&regions, twin, &events).iter().filter(|fetch| fetch.2).count() as u64;
            events.iter().for_each(|event| counted &= !matches!(event, Event::Block { warm_up: true }));
            assert_eq!(row.more.full_lru_fetches, Some(full));
            let conflict = row.conflict().unwrap();
            assert_eq!((row.compulsory + row.capacity().unwrap()) as i64 + conflict, row.fetches as i64);
            assert!(conflict == 0 || row.config.ways() != Ways::Full);
            conflicts += i64::from(conflict > 0);
            anti += i64::from(conflict < 0);
        }
    }
    assert!(conflicts > 100 && anti > 5, "{conflicts} conflicts, {anti} below zero");
}

#[test]
fn records_can_count_by_their_first_byte_alone() {
    let mut random = Random(24);
    for _ in 0..300 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let bytes: Vec<Event> = events
            .iter()
            .cloned()
            .map(|event| match event {
                Event::Access(access) => Event::Access(Access { len: access.len.min(1), ..access }),
                other => other,
            })
            .collect();
        let configs = ["1K,full,16,lru", "1K,2,128,lru"].map(|text| text.parse().unwrap());
        let first = Measures { span: Span::First, curves: vec![16], working_sets: true, ..Measures::default() };
        let both = Measures { span: Span::Both, ..first.clone() };
        let (first, both) =
            (findings(&regions, &configs, &first, &events, 2048), findings(&regions, &configs, &both, &bytes, 2048));
        for (a, b) in first.rows.iter().zip(&both.rows) {
            assert_eq!((a.accesses, a.fetches, a.compulsory), (b.accesses, b.fetches, b.compulsory));
            assert_eq!((a.bytes_written_back, &a.more), (b.bytes_written_back, &b.more));
        }
        assert!((0..20).all(|lines| first.curves[0].fetches(lines) == both.curves[0].fetches(lines)));
    }
}

#[test]
fn results_go_through_a_cache_like_any_other() {
    let mut random = Random(25);
    for case in 0..300 {
        let pixel_bytes = random.pick(&[12_u32, 16, 100]);
        let cache_bytes = random.pick(&[32_u64, 320, 4096]);
        let memory = ResultMemory { cache_bytes, pixel_bytes, tile_pixels: None };
        let (mut events, mut at) = (vec![], 0);
        let warm_ups = random.below(2) == 0;
        for _ in 0..300 {
            match random.below(30) {
                0 => events.push(Event::Block { warm_up: warm_ups && random.below(2) == 0 }),
                1 => at = random.below(900) as u32,
                _ => {
                    at += random.below(3) as u32;
                    events.push(Event::Search(vec![at; random.below(3) as usize]));
                }
            }
        }
        let measures = Measures { results: Some(memory), ..Measures::default() };
        let found = findings(&[], &[], &measures, &events, 2048).result_bytes;
        // The same as reads and writes of a region of pixels.
        let base = 0;
        let size = 2000 * u64::from(pixel_bytes);
        let pixels = [Region { name: "pixels".into(), base, size, record_size: 4, coding: Coding::Records }];
        let touches: Vec<Event> = events
            .iter()
            .flat_map(|event| match event {
                Event::Search(pixels) => pixels
                    .iter()
                    .map(|&pixel| {
                        let offset = u64::from(pixel) * u64::from(pixel_bytes);
                        let kind = AccessKind::ReadModifyWrite;
                        Event::Access(Access { kind, region: 0, len: pixel_bytes, offset })
                    })
                    .collect(),
                other => vec![other.clone()],
            })
            .collect();
        let config = CacheConfig::lru(cache_bytes, Ways::Full, SECTOR_BYTES as u32).unwrap();
        let row = oracle(&pixels, config, &touches);
        assert_eq!(found, Some(row.bytes_fetched + row.bytes_written_back), "case {case}: {memory:?}");
    }
}

#[test]
fn a_tile_in_hand_is_written_once() {
    // A batch of 8 pixels, 12 bytes each: three sectors. Each has been added to four times.
    let memory = ResultMemory { cache_bytes: 96, pixel_bytes: 12, tile_pixels: Some(8) };
    assert!(memory.holds_tiles());
    let measures = Measures { results: Some(memory), ..Measures::default() };
    let mut simulation = Simulation::measuring(&[], &[], &measures).unwrap();
    for tile in 0..5 {
        // The third is warm-up. A tile may come in several blocks.
        for _ in 0..2 {
            simulation.block(tile, tile == 2);
            (0..16).for_each(|i| simulation.search(&[tile as u32 * 8 + i % 8]));
        }
    }
    assert_eq!(simulation.findings().result_bytes, Some(4 * 96));
    // A byte less, and the tile does not fit.
    assert!(!ResultMemory { cache_bytes: 95, ..memory }.holds_tiles());
    assert!(!ResultMemory { tile_pixels: None, ..memory }.holds_tiles());
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
    let mut random = Random(26);
    let mut fetched = 0;
    for case in 0..500 {
        let mut regions = random_regions(&mut random);
        // Regions of a trace do not share pages and begin on one.
        regions.iter_mut().for_each(|region| region.base = region.base.next_multiple_of(4096));
        let events = within_searches(random_events(&mut random, &regions));
        let first: CacheConfig =
            random.pick(&["512,2,64,lru", "1K,full,64,lru", "256,1,16,lru", "64K,full,16K,lru"]).parse().unwrap();
        let second: CacheConfig = random.pick(&["2K,full,64,lru", "4K,4,128,lru", "1K,full,32,lru"]).parse().unwrap();
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
        assert_eq!(found.rows[0].fetches, oracle(&regions, first, &events).fetches);

        // And the second, on what comes through.
        let mut simulation = Simulation::new(&header.regions, &[second]).unwrap();
        super::tests::replay(&stream, &mut simulation);
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
