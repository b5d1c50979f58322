//! Does every policy do what is plain?

use pm_formats::trace::{Access, Coding, Region};
use pm_registry::Registry;

use super::caches::{of_caches, some_ways, ways_for};
use super::naive::Cost;
use super::{Draw, Event, random_events, random_regions, simulate};
use crate::{CacheConfig, ChosenPolicy, Policy, Ways};

/// A cache under each policy reads from its word in a configuration, prints as that, and reads back the same.
///
/// # Panics
/// If it does not.
pub fn words_are_read_as_they_are_printed(policies: &Registry<dyn Policy>) {
    for policy in of_caches(policies) {
        let ways = ways_for(policy, 8);
        for text in [format!("{},full,64,{policy}", ways * 64), format!("{},{ways},64,{policy},hash", ways * 256)] {
            let read = |text: &str| CacheConfig::parse(text, policies).unwrap_or_else(|error| panic!("{error}"));
            let config = read(&text);
            assert_eq!(config.policy(), policy, "{text}");
            assert_eq!(read(&config.to_string()), config, "{text}");
        }
    }
    for entry in policies.iter() {
        let (word, help) = (entry.word(), entry.help());
        let plain = word.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
        assert!(plain && !word.is_empty(), "`{word}` is no word: lower case, digits and hyphens");
        assert!(!help.is_empty() && !help.contains('\n') && !help.ends_with('.'), "{word}: {help}");
    }
    let unknown = ChosenPolicy::parse("?", policies).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(policies.words().iter().all(|word| unknown.contains(word)), "{unknown}");
}

/// Address 0 is an address like any other: two well-known simulators took zero, as a time or as a tag, for "nothing yet".
///
/// # Panics
/// If it is not.
pub fn the_first_access_may_be_to_address_zero(policies: &Registry<dyn Policy>) {
    let regions = [Region { name: "a".into(), base: 0, size: 4096, record_size: 4, coding: Coding::Records }];
    let events: Vec<Event> = [0, 0, 4, 0].map(|offset| Event::Access(Access::read(0, offset, 4))).into();
    for policy in of_caches(policies) {
        for (lines, ways) in [(1, None), (16, None), (16, Some(1)), (16, Some(4))] {
            let ways = ways.map(|ways| ways_for(policy, ways));
            let lines = ways.map_or(ways_for(policy, lines), |ways| 4 * ways);
            let config = CacheConfig::new(lines * 4, ways.map_or(Ways::Full, some_ways), 4, policy);
            let config = config.unwrap_or_else(|error| panic!("{error}"));
            let counts = simulate(&regions, &[config], &events, 2048).remove(0);
            let once = config.lines() > 1 || policy.entry().bypasses();
            assert_eq!((counts.accesses, counts.fetches), (4, if once { 2 } else { 3 }), "{config}");
            assert_eq!(counts.compulsory, 2, "{config}");
        }
    }
}

/// With one line in each set, one line in all, or more lines than there are, every policy fetches the same.
///
/// # Panics
/// If it does not.
pub fn where_there_is_no_choice_all_are_one(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(12);
    for _ in 0..300 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        for (lines, ways) in [(16, Some(1)), (1, None), (1, Some(1)), (1 << 12, None), (1 << 12, Some(8))] {
            // To pass by is a choice where not all lines find a place.
            let has_none = |policy: &ChosenPolicy| {
                let needed = ways.unwrap_or(lines);
                ways_for(*policy, needed) == needed && (lines > 16 || !policy.entry().bypasses())
            };
            let config = |policy| CacheConfig::new(lines * 64, ways.map_or(Ways::Full, some_ways), 64, policy);
            let policies = of_caches(policies).into_iter().filter(has_none);
            let configs: Vec<CacheConfig> = policies.map(|policy| config(policy).expect("such a cache")).collect();
            let counts = simulate(&regions, &configs, &events, 2048);
            for of in &counts {
                assert_eq!(Cost::of(of), Cost::of(&counts[0]), "{} and {}", of.config, counts[0].config);
            }
        }
    }
}

/// A cache with as many ways as lines is a fully associative one.
///
/// # Panics
/// If it is not.
pub fn a_cache_of_one_set_is_full(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(13);
    for _ in 0..300 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        for policy in of_caches(policies) {
            let ways = ways_for(policy, 8);
            let cache = |ways_of_set| CacheConfig::new(ways * 64, ways_of_set, 64, policy).expect("such a cache");
            let configs = [cache(Ways::Full), cache(some_ways(ways)).hashed().expect("ways")];
            let pair = simulate(&regions, &configs, &events, 2048);
            assert_eq!(Cost::of(&pair[0]), Cost::of(&pair[1]), "{policy}");
        }
    }
}
