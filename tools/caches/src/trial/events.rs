//! Random traces, the same on every run, and simulations of them.

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink, lay_out};
use pm_random::Random;

use crate::{CacheConfig, CacheCounts, Measures, Simulation};

/// What a trace replays.
#[derive(Clone, Debug)]
pub(crate) enum Event {
    Block { warm_up: bool },
    Search(Vec<u32>),
    Access(Access),
}

/// Draws small random numbers.
pub(crate) struct Draw(Random);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Random::new(&[seed]))
    }

    pub(crate) fn below(&mut self, n: u64) -> u64 {
        self.0.next_u64() % n
    }

    pub(crate) fn pick<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.below(of.len() as u64) as usize].clone()
    }
}

pub(crate) fn replay(events: &[Event], sink: &mut dyn TraceSink) {
    for event in events {
        match event {
            Event::Block { warm_up } => sink.block(0, *warm_up),
            Event::Search(destinations) => sink.search(destinations),
            Event::Access(access) => sink.access(*access),
        }
    }
}

/// Simulates so many accesses at a time.
pub(crate) fn simulate(
    regions: &[Region],
    configs: &[CacheConfig],
    events: &[Event],
    chunk: usize,
) -> Vec<CacheCounts> {
    let mut simulation = Simulation::in_chunks(regions, configs, &Measures::default(), chunk).expect("small regions");
    replay(events, &mut simulation);
    simulation.finish()
}

pub(crate) fn random_regions(draw: &mut Draw) -> Vec<Region> {
    let mut regions = lay_out((0..draw.below(4) + 1).map(|i| {
        let size = draw.pick(&[1, 40, 500, 4096, 9000, 20_000]);
        (format!("region {i}"), size, 20, Coding::Records)
    }));
    // Anywhere in the address space, the very beginning included.
    let shift = draw.pick(&[0, 4096, 1 << 40]);
    regions.iter_mut().for_each(|r| r.base = r.base - 4096 + shift);
    regions
}

pub(crate) fn random_events(draw: &mut Draw, regions: &[Region]) -> Vec<Event> {
    let writes = draw.below(2) == 0;
    let longest = draw.pick(&[1, 20, 20, 300]);
    let warm_ups = draw.below(2) == 0;
    // How far an access may be from the one before: loops, walks and leaps.
    let leap = draw.pick(&[1, 50, 2000, 20_000]);
    // How many of ten accesses are to where the one before was.
    let stays = draw.pick(&[0, 0, 4, 8]);
    let (mut region, mut at) = (0, 0);
    let mut events = Vec::new();
    for _ in 0..draw.below(400) {
        match draw.below(20) {
            0 => events.push(Event::Block { warm_up: warm_ups && draw.below(2) == 0 }),
            1 => events.push(Event::Search((0..draw.below(3) as u32).collect())),
            _ => {
                if events.is_empty() || draw.below(10) >= stays {
                    region = draw.below(regions.len() as u64) as u16;
                    at = (at + draw.below(leap)) % regions[region as usize].size;
                }
                let len = (draw.below(longest + 1)).min(regions[region as usize].size - at) as u32;
                let kind = match draw.below(8) {
                    0 if writes => AccessKind::Write,
                    1 if writes => AccessKind::ReadModifyWrite,
                    _ => AccessKind::Read,
                };
                events.push(Event::Access(Access { kind, region, len, offset: at }));
            }
        }
    }
    events
}
