//! What the benches share: a room of points, and a clock that a busy machine does not disturb.

use pm_random::Random;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// Five walls of the unit cube and a ball in it.
pub(crate) fn surface_point(random: &mut Random) -> [f32; 3] {
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
