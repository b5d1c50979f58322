//! Does no policy depend on what it must not depend on?

use pm_formats::trace::{Access, Coding, lay_out};
use pm_registry::Registry;

use super::caches::{of_caches, random_cache, some_ways, ways_for};
use super::{Draw, Event, random_events, random_regions, simulate};
use crate::{CacheConfig, Policy};

/// However many accesses are simulated at a time, and whenever, all is counted the same.
///
/// # Panics
/// If it is not.
pub fn chunks_one_after_another_are_the_whole(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(14);
    for _ in 0..100 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        for policy in of_caches(policies) {
            let config = [random_cache(&mut draw, policy)];
            let whole = simulate(&regions, &config, &events, 2048);
            for chunk in [1, 3, 64, 2048] {
                assert_eq!(simulate(&regions, &config, &events, chunk), whole, "chunks of {chunk} and of 2048");
            }
        }
    }
}

/// A cache counts the same by itself and beside caches of every other policy, some of which may need accesses that it says
/// it need not see.
///
/// # Panics
/// If it does not.
pub fn a_cache_does_not_depend_on_those_beside_it(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(17);
    for _ in 0..100 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let mut configs: Vec<CacheConfig> =
            of_caches(policies).iter().map(|&policy| random_cache(&mut draw, policy)).collect();
        configs.push(CacheConfig::none(16).expect("a line"));
        configs.extend(of_caches(policies).iter().map(|&policy| random_cache(&mut draw, policy)));
        let together = simulate(&regions, &configs, &events, 2048);
        for (beside, &config) in together.iter().zip(&configs) {
            assert_eq!(*beside, simulate(&regions, &[config], &events, 2048)[0], "left: beside others, right: alone");
        }
    }
}

/// A policy that says that it need not see a use of the line used last counts the same with and without such uses.
///
/// # Panics
/// If it does not.
pub fn repeats_are_left_out_only_where_they_do_not_matter(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(18);
    for case in 0..300 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        for policy in of_caches(policies) {
            let config = random_cache(&mut draw, policy);
            // Simulated one by one no access has one before it.
            let (with, without) =
                (simulate(&regions, &[config], &events, 1), simulate(&regions, &[config], &events, 2048));
            assert_eq!(
                with[0].region_fetches, without[0].region_fetches,
                "case {case}: {config} counts otherwise (right) where uses of the line used last are left out, so it must say \
                 that it needs them: Replacement::REPEATS_MATTER, CacheModel::repeats_matter"
            );
        }
    }
}

/// Where a policy says so, a set that has seen as many distinct lines as it has ways holds the same lines as if it had run
/// for ever.
///
/// # Panics
/// If it does not.
pub fn what_is_said_to_be_forgotten_is_forgotten(policies: &Registry<dyn Policy>) {
    const LINES: u64 = 256;
    let mut draw = Draw::new(19);
    let regions = lay_out([("a".to_owned(), LINES * 16, 16, Coding::Records)]);
    let read = |line: u64| Event::Access(Access::read(0, line * 16, 16));
    for policy in of_caches(policies).into_iter().filter(|policy| policy.entry().forgets_what_was_before()) {
        for _ in 0..300 {
            let (sets, ways) = (draw.pick(&[1, 4]), ways_for(policy, draw.pick(&[1, 2, 4, 8, 16])));
            let config = CacheConfig::new(sets * ways * 16, some_ways(ways), 16, policy).expect("such a cache");
            let mut reads = |number: u64| -> Vec<Event> { (0..number).map(|_| read(draw.below(LINES))).collect() };
            let (before, after) = (reads(200), reads(200));
            // Each set gets as many lines as it has ways.
            let filling: Vec<Event> = (0..config.lines()).map(read).collect();
            let fetches_after = |before: &[Event]| {
                let (warm_up, counted) = ([Event::Block { warm_up: true }], [Event::Block { warm_up: false }]);
                let events = [&warm_up, before, &filling, &counted, &after].concat();
                simulate(&regions, &[config], &events, 2048)[0].fetches
            };
            assert_eq!(fetches_after(&before), fetches_after(&[]), "{config}: what was before is not forgotten");
        }
    }
}
