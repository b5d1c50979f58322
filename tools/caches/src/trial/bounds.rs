//! Does no policy count less than there must be, or more than there can be?

use std::collections::BTreeSet;

use pm_registry::Registry;

use super::caches::{of_caches, random_cache};
use super::definition::line_accesses;
use super::{Draw, Event, random_events, random_regions, simulate};
use crate::policies::{Min, MinBypass};
use crate::{CacheConfig, ChosenPolicy, Policy, SetIndex};

/// Compulsory fetches are the distinct lines; they are among the fetches, and these among the accesses; those of the regions
/// are all there are; and what a trace costs up to somewhere is part of what it costs in all.
///
/// # Panics
/// If not.
pub fn counts_add_up(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(15);
    for case in 0..300 {
        let regions = random_regions(&mut draw);
        let mut events = random_events(&mut draw, &regions);
        // Warm-up fetches lines that are then nobody's.
        events.retain(|event| !matches!(event, Event::Block { .. }));
        let part = &events[..draw.below(events.len() as u64 + 1) as usize];
        for policy in of_caches(policies) {
            let config = random_cache(&mut draw, policy);
            let (counts, of_part) =
                (&simulate(&regions, &[config], &events, 2048)[0], &simulate(&regions, &[config], part, 2048)[0]);
            let place = format!("case {case}, {config}");
            let accesses = line_accesses(&regions, config.line_bytes(), &events);
            let distinct: BTreeSet<u64> = accesses.iter().map(|access| access.line).collect();
            assert_eq!(counts.compulsory, distinct.len() as u64, "{place}");
            assert_eq!(counts.accesses, accesses.len() as u64, "{place}");
            assert!(counts.compulsory <= counts.fetches && counts.fetches <= counts.accesses, "{place}");
            assert_eq!(counts.region_fetches.iter().sum::<u64>(), counts.fetches, "{place}");
            assert_eq!(counts.bytes_fetched, counts.fetches * u64::from(config.line_bytes()), "{place}");
            assert!(of_part.fetches <= counts.fetches && of_part.compulsory <= counts.compulsory, "{place}");
            assert!(of_part.bytes_written_back <= counts.bytes_written_back, "{place}");
        }
    }
}

/// No policy fetches less than Belady's optimum, nor than the one that may pass by if it does.
///
/// # Panics
/// If one does.
pub fn no_policy_fetches_less_than_the_optimum(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(24);
    for case in 0..1000 {
        let regions = random_regions(&mut draw);
        let mut events = random_events(&mut draw, &regions);
        // What warm-up fetches is not counted, but it is part of what is least.
        events.retain(|event| !matches!(event, Event::Block { .. }));
        for policy in of_caches(policies) {
            let config = random_cache(&mut draw, policy);
            let same = |entry: &'static dyn Policy| {
                let policy = ChosenPolicy::new(entry);
                let same = CacheConfig::new(config.size_bytes(), config.ways(), config.line_bytes(), policy);
                let same = same.expect("the optimum has any number of ways");
                if config.index() == SetIndex::Hash { same.hashed().expect("ways") } else { same }
            };
            let configs = [config, same(&Min), same(&MinBypass)];
            let [own, min, bypass] = &simulate(&regions, &configs, &events, 2048)[..] else { panic!("three caches") };
            let least = if policy.entry().bypasses() { bypass } else { min };
            assert!(least.fetches <= own.fetches, "case {case}, {config}: less than {}", least.config);
            assert!(bypass.compulsory <= bypass.fetches && bypass.fetches <= min.fetches, "case {case}, {config}");
        }
    }
}
