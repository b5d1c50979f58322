//! Do the measures besides the caches' own counts agree with plain models of them?

use std::collections::BTreeSet;

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink};

use crate::plain_lru::{batch, findings, lines, naive_fetches, oracle};
use crate::trial::{Draw, Event, random_events, random_regions};
use crate::{CacheConfig, Measures, ResultMemory, SECTOR_BYTES, Simulation, SpanRule, Ways};

#[test]
fn working_sets_are_sets() {
    let mut draw = Draw::new(21);
    let mut batches = 0;
    for case in 0..600 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let chunk = draw.pick(&[1, 5, 60, 2048]);
        let measures = Measures { working_sets: true, ..Measures::default() };
        let row = findings(&regions, &["1K,full,32,lru".parse().unwrap()], &measures, &events, chunk).caches.remove(0);
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
fn misses_are_compulsory_capacity_and_conflict() {
    let mut draw = Draw::new(23);
    let (mut conflicts, mut anti) = (0, 0);
    for _ in 0..400 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let configs = ["256,2,64,lru", "none,64", "256,full,64,lru", "128,1,64,lru", "256,1,16,lru", "256,2,64,lru"]
            .map(|text| text.parse().unwrap());
        let rows = findings(&regions, &configs, &Measures { split: true, ..Measures::default() }, &events, 2048).caches;
        assert!(rows.iter().map(|row| row.config).eq(configs), "twins are not shown");
        for row in &rows {
            if !row.config.keeps_lines() {
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
    let mut draw = Draw::new(24);
    for _ in 0..300 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let bytes: Vec<Event> = events
            .iter()
            .cloned()
            .map(|event| match event {
                Event::Access(access) => Event::Access(Access { len: access.len.min(1), ..access }),
                other => other,
            })
            .collect();
        let configs = ["1K,full,16,lru", "1K,2,128,lru"].map(|text| text.parse().unwrap());
        let first = Measures { span: SpanRule::First, curves: vec![16], working_sets: true, ..Measures::default() };
        let both = Measures { span: SpanRule::Both, ..first.clone() };
        let (first, both) =
            (findings(&regions, &configs, &first, &events, 2048), findings(&regions, &configs, &both, &bytes, 2048));
        for (a, b) in first.caches.iter().zip(&both.caches) {
            assert_eq!((a.accesses, a.fetches, a.compulsory), (b.accesses, b.fetches, b.compulsory));
            assert_eq!((a.bytes_written_back, &a.more), (b.bytes_written_back, &b.more));
        }
        assert!((0..20).all(|lines| first.curves[0].fetches(lines) == both.curves[0].fetches(lines)));
    }
}

#[test]
fn results_go_through_a_cache_like_any_other() {
    let mut draw = Draw::new(25);
    for case in 0..300 {
        let pixel_bytes = draw.pick(&[12_u32, 16, 100]);
        let cache_bytes = draw.pick(&[32_u64, 320, 4096]);
        let memory = ResultMemory { cache_bytes, pixel_bytes, tile_pixels: None };
        let (mut events, mut at) = (vec![], 0);
        let warm_ups = draw.below(2) == 0;
        for _ in 0..300 {
            match draw.below(30) {
                0 => events.push(Event::Block { warm_up: warm_ups && draw.below(2) == 0 }),
                1 => at = draw.below(900) as u32,
                _ => {
                    at += draw.below(3) as u32;
                    events.push(Event::Search(vec![at; draw.below(3) as usize]));
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
