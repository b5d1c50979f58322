//! Does every policy count what its definition does, wherever in 64 bits the addresses lie?

use std::collections::BTreeSet;

use pm_formats::trace::{Access, AccessKind, Region};
use pm_registry::Registry;

use super::caches::{of_caches, random_cache};
use super::definition::line_accesses;
use super::naive::{Cost, fetches, naive};
use super::{Draw, Event, replay};
use crate::{Measures, Policy, Simulation};

/// Accesses in some places that lie anywhere: at both ends of all addresses, side by side, powers of two apart, by chance.
pub(crate) fn wild_events(draw: &mut Draw) -> Vec<Event> {
    let stride = 1_u64 << draw.below(64);
    let places: Vec<u64> = (0..1 + draw.below(60))
        .map(|i| match draw.below(6) {
            0 => draw.pick(&[0, u64::MAX]),
            1 | 2 => i.wrapping_mul(stride),
            3 => i * 4096,
            _ => draw.below(u64::MAX),
        })
        .collect();
    let near = draw.pick(&[1, 200, 5000, 40_000]);
    let longest = draw.pick(&[1, 20, 300, 20_000]);
    // The definition of the optimum looks through all that follows, for each line: long accesses are few.
    let most = 300_u64.min(6000 / longest);
    let (writes, warm_ups) = (draw.below(2) == 0, draw.below(2) == 0);
    let mut events = vec![];
    for _ in 0..draw.below(most + 2) {
        if draw.below(20) == 0 {
            events.push(Event::Block { warm_up: warm_ups && draw.below(2) == 0 });
            continue;
        }
        let offset = draw.pick(&places).wrapping_add(draw.below(near)).wrapping_sub(near / 2);
        let len = draw.below(longest + 1).min((u64::MAX - offset).saturating_add(1)) as u32;
        let kind = match draw.below(8) {
            0 if writes => AccessKind::Write,
            1 if writes => AccessKind::ReadModifyWrite,
            _ => AccessKind::Read,
        };
        events.push(Event::Access(Access { kind, region: 0, len, offset }));
    }
    events
}

/// The 4 KiB pages that a trace touches.
pub(crate) fn pages(events: &[Event]) -> u64 {
    let pages = events.iter().filter_map(|event| match event {
        Event::Access(Access { offset, len, .. }) => Some(offset >> 12..=(offset + u64::from((*len).max(1) - 1)) >> 12),
        _ => None,
    });
    pages.flatten().collect::<BTreeSet<u64>>().len() as u64
}

/// What random caches fetch of traces of any addresses, which lines and in which order, is what the policy's definition
/// fetches; blocks are those of the pages touched.
///
/// # Panics
/// If it is not.
pub fn addresses_may_lie_anywhere(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(31);
    let (policies, regions) = (of_caches(policies), [Region::addresses("trace")]);
    for case in 0..2000 {
        let events = wild_events(&mut draw);
        for &policy in &policies {
            let config = random_cache(&mut draw, policy);
            let chunk = draw.pick(&[1, 2, 5, 60, 2048]);
            let simulation = Simulation::in_chunks(&regions, &[config], &Measures::default(), chunk);
            let mut simulation = simulation.expect("any addresses");
            simulation.keep_fetched();
            replay(&events, &mut simulation);
            let mut fetched = vec![];
            simulation.take_fetched(&mut fetched);
            let counts = &simulation.finish()[0];
            let accesses = line_accesses(&regions, config.line_bytes(), &events);
            let (expected, moves) = naive(config, 1, &accesses);
            let what = format!("case {case}, {config}, chunk {chunk}: left: model, right: definition");
            assert_eq!(Cost::of(counts), expected, "{what}");
            assert_eq!(fetched, fetches(moves), "{what}");
            assert_eq!(counts.blocks, (pages(&events) * 4096).div_ceil(config.line_bytes().into()), "{what}");
        }
    }
}
