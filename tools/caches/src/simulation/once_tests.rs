//! Records that count once: a record that spans lines is one access, and one miss at most.

use pm_formats::trace::{Access, Region};

use super::Simulation;
use crate::plain_lru::findings;
use crate::trial::{Draw, Event, line_accesses, random_events, random_regions, wild_events};
use crate::{CacheConfig, Measures, SpanRule, Ways};

/// Records and records that miss, of those that count, in a list of the lines last used.
fn plain(regions: &[Region], config: CacheConfig, events: &[Event]) -> (u64, u64) {
    let (mut list, mut records, mut missed, mut counted): (Vec<u64>, _, _, _) = (vec![], 0, 0, true);
    for event in events {
        if let Event::Block { warm_up } = event {
            counted = !warm_up;
        }
        let lines = line_accesses(regions, config.line_bytes(), std::slice::from_ref(event));
        let mut misses = 0;
        for access in &lines {
            let held = list.iter().position(|&line| line == access.line);
            misses += u64::from(held.is_none());
            held.map(|at| list.remove(at));
            list.insert(0, access.line);
            list.truncate(config.lines() as usize);
        }
        records += u64::from(counted && !lines.is_empty());
        missed += u64::from(counted && misses > 0);
    }
    (records, missed)
}

#[test]
fn a_record_misses_once_at_most() {
    let mut draw = Draw::new(51);
    let measures = Measures { span: SpanRule::Once, ..Measures::default() };
    let mut spared = 0;
    for case in 0..400 {
        let wild = draw.below(2) == 0;
        let regions = if wild { vec![Region::addresses("x")] } else { random_regions(&mut draw) };
        let events = if wild { wild_events(&mut draw) } else { random_events(&mut draw, &regions) };
        let line = draw.pick(&[4_u32, 16, 128, 8192]);
        let configs = [1_u64, 3, 40].map(|lines| CacheConfig::lru(lines * u64::from(line), Ways::Full, line).unwrap());
        let chunk = draw.pick(&[1, 60, 2048]);
        let both = findings(&regions, &configs, &Measures::default(), &events, chunk).caches;
        for (row, both) in findings(&regions, &configs, &measures, &events, chunk).caches.iter().zip(&both) {
            let found = (row.accesses, row.fetches);
            assert_eq!(found, plain(&regions, row.config, &events), "case {case}: {}, chunk {chunk}", row.config);
            // What goes over the bus are lines as ever.
            assert_eq!((row.bytes_fetched, row.bytes_written_back), (both.bytes_fetched, both.bytes_written_back));
            assert_eq!(row.compulsory, both.compulsory);
            spared += both.fetches - row.fetches;
        }
    }
    assert!(spared > 1000, "{spared}");
}

#[test]
fn eight_bytes_over_the_end_of_a_line_are_one_miss() {
    let regions = [Region::addresses("x")];
    for (span, fetches) in [(SpanRule::Both, 2), (SpanRule::First, 1), (SpanRule::Once, 1)] {
        let measures = Measures { span, ..Measures::default() };
        let caches = ["1K,full,64,lru".parse().unwrap()];
        let mut simulation = Simulation::measuring(&regions, &caches, &measures).unwrap();
        pm_formats::trace::TraceSink::access(&mut simulation, Access::read(0, 60, 8));
        assert_eq!(simulation.finish()[0].fetches, fetches, "{span:?}");
    }
}
