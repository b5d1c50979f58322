//! What the benches share: a room of points, and a clock that a busy machine does not disturb.

use pm_formats::Photon;
use pm_random::Random;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

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

/// Five walls of the unit cube and a ball in it.
fn surface_point(random: &mut Random) -> [f32; 3] {
    let (u, v) = (random.unit(), random.unit());
    match (random.unit() * 5.5) as u32 {
        0 => [u, v, 0.0],
        1 => [u, v, 1.0],
        2 => [0.0, u, v],
        3 => [1.0, u, v],
        4 => [u, 0.0, v],
        _ => {
            let (z, turn) = (2.0 * u - 1.0, std::f32::consts::TAU * v);
            let r = (1.0 - z * z).sqrt();
            [0.6 + 0.2 * r * turn.cos(), 0.3 + 0.2 * r * turn.sin(), 0.5 + 0.2 * z]
        }
    }
}

/// Bits of the three coordinates interleaved: the number of a point's cell.
pub(crate) fn morton(p: &[f32; 3]) -> u64 {
    (0..16).flat_map(|bit| (0..3).map(move |axis| (bit, axis))).fold(0, |key, (bit, axis)| {
        let cell = (p[axis] * 65535.0) as u64;
        key << 1 | (cell >> (15 - bit) & 1)
    })
}

/// How long this thread has run. Where the system does not tell, how long ago the first call was.
pub(crate) fn cpu_time() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    // Linux: nanoseconds on a processor, nanoseconds waiting for one, number of turns.
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = times.and_then(|times| times.split(' ').next()?.parse().ok());
    nanoseconds.map_or_else(|| START.elapsed(), Duration::from_nanos)
}

/// The middle of some numbers.
pub(crate) fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}
