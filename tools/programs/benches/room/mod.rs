//! Photons, and where they are searched for.

use crate::common::surface_point;
use pm_formats::Photon;
use pm_random::Random;

/// What a bench is asked for, and what of.
pub(crate) struct Room {
    pub(crate) queries: usize,
    pub(crate) rounds: usize,
    pub(crate) photons: Vec<Photon>,
    /// Where to search, in no order.
    pub(crate) scattered: Vec<[f32; 3]>,
}

impl Room {
    /// As the command line asks: `[QUERIES [ROUNDS [PHOTONS]]]`.
    pub(crate) fn asked_for() -> Self {
        let numbers: Vec<usize> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
        let number = |at: usize, default: usize| numbers.get(at).copied().unwrap_or(default);
        let (queries, rounds, count) = (number(0, 20_000), number(1, 7), number(2, 100_000));
        let mut random = Random::new(&[1]);
        let up = [0.0, 1.0, 0.0];
        let photons: Vec<Photon> = (0..count)
            .map(|_| Photon::new(surface_point(&mut random), [1.0; 3], [0.5; 3], up, up).expect("a plain photon"))
            .collect();
        let scattered = (0..queries).map(|_| surface_point(&mut random)).collect();
        Self { queries, rounds, photons, scattered }
    }
}
