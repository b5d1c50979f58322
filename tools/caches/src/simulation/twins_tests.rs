//! Are misses shared with the twin as plain lists have them?

use crate::plain_lru::{findings, naive_fetches};
use crate::trial::{Draw, Event, line_accesses, random_events, random_regions};
use crate::{CacheConfig, Measures, Ways};

/// Which of the line accesses that count miss, with a list for each set.
fn misses(regions: &[pm_formats::trace::Region], config: CacheConfig, events: &[Event]) -> Vec<bool> {
    let mut sets: Vec<Vec<u64>> = vec![vec![]; config.sets() as usize];
    let ways = (config.lines() / config.sets()) as usize;
    let mut missed = vec![];
    for access in line_accesses(regions, config.line_bytes(), events) {
        let set = &mut sets[(access.line % config.sets()) as usize];
        let held = set.iter().position(|&line| line == access.line);
        held.map(|at| set.remove(at));
        set.insert(0, access.line);
        set.truncate(ways);
        missed.push(held.is_none());
    }
    missed
}

#[test]
fn capacity_and_conflict_miss_by_miss_are_those_of_plain_lists() {
    let mut draw = Draw::new(61);
    let mut conflicts = 0;
    for case in 0..400 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let events: Vec<Event> = events.into_iter().filter(|event| !matches!(event, Event::Block { .. })).collect();
        let line = draw.pick(&[16_u32, 128]);
        let ways = |n: u32| Ways::N(std::num::NonZeroU32::new(n).unwrap());
        let configs = [(8, ways(1)), (12, ways(4)), (9, ways(3)), (8, Ways::Full)]
            .map(|(lines, ways)| CacheConfig::lru(lines * u64::from(line), ways, line).unwrap());
        let measures = Measures { miss_by_miss: true, ..Measures::default() };
        let chunk = draw.pick(&[1, 60, 2048]);
        for row in findings(&regions, &configs, &measures, &events, chunk).caches {
            let full = CacheConfig::lru(row.config.size_bytes(), Ways::Full, line).unwrap();
            let (own, twins) = (misses(&regions, row.config, &events), misses(&regions, full, &events));
            let both = own.iter().zip(&twins).filter(|(a, b)| **a && **b).count() as u64;
            let what = format!("case {case}: {}", row.config);
            assert_eq!(row.more.missed_by_both, Some(both), "{what}");
            let (capacity, conflict) = (row.capacity_by_miss().unwrap(), row.conflict_by_miss().unwrap());
            assert_eq!(row.compulsory + capacity + conflict, row.fetches, "{what}");
            assert_eq!(conflict, own.iter().zip(&twins).filter(|(a, b)| **a && !**b).count() as u64, "{what}");
            conflicts += conflict;
        }
    }
    assert!(conflicts > 1000, "{conflicts}");
}

#[test]
fn rows_of_banks_are_those_of_a_list_of_fetches() {
    let mut draw = Draw::new(62);
    for case in 0..200 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let config: CacheConfig = "512,2,64,lru".parse().unwrap();
        let measures = Measures { dram: Some("4,256,open".parse().unwrap()), ..Measures::default() };
        let row = findings(&regions, &[config], &measures, &events, draw.pick(&[1, 2048])).caches.remove(0);
        let (mut open, mut counts) = ([None; 4], (0, 0, 0));
        for (_, line, counted, _) in naive_fetches(&regions, config, &events) {
            let row = line * 64 / 256;
            let bank = &mut open[(row % 4) as usize];
            if counted {
                counts.0 += u64::from(*bank == Some(row));
                counts.1 += u64::from(bank.is_some_and(|open| open != row));
                counts.2 += u64::from(*bank != Some(row));
            }
            *bank = Some(row);
        }
        let found = row.more.dram.unwrap();
        assert_eq!((found.hits, found.conflicts, found.activates), counts, "case {case}");
    }
}
