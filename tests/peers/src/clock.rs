//! How long this thread has run on a processor, whoever else was running.

use nix::time::{ClockId, clock_gettime};

/// Nanoseconds that some work took.
pub(crate) fn nanoseconds<T>(work: impl FnOnce() -> T) -> anyhow::Result<(T, f64)> {
    let now = || clock_gettime(ClockId::CLOCK_THREAD_CPUTIME_ID);
    let start = now()?;
    let done = work();
    let took = std::time::Duration::from(now()? - start);
    Ok((done, took.as_nanos() as f64))
}

/// The middle of some numbers.
pub(crate) fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}
