//! What it takes to build a map: time, and memory at its peak.

use crate::clock;
use std::fs;
use std::time::Instant;

/// What building something took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Building {
    /// Seconds of the clock on the wall.
    pub(super) seconds: f64,
    /// Seconds that it took on processors.
    pub(super) processor_seconds: f64,
    /// Bytes of memory in use at the peak, beyond those in use before; unknown where the system does not tell.
    pub(super) peak_bytes: Option<u64>,
}

impl Building {
    /// Builds something and measures it.
    ///
    /// # Errors
    /// Those of `build`.
    pub(super) fn measure<T, E>(build: impl FnOnce() -> Result<T, E>) -> Result<(T, Self), E> {
        // Linux: forget the peak so far (proc(5), clear_refs). Elsewhere the peak stays unknown.
        let before = fs::write("/proc/self/clear_refs", "5").ok().and_then(|()| status_bytes("VmRSS:"));
        let (start, processors) = (Instant::now(), clock::own_seconds());
        let built = build()?;
        let (seconds, processor_seconds) = (start.elapsed().as_secs_f64(), clock::own_seconds() - processors);
        let peak = before.zip(status_bytes("VmHWM:"));
        let peak_bytes = peak.map(|(before, peak)| peak.saturating_sub(before));
        Ok((built, Self { seconds, processor_seconds, peak_bytes }))
    }
}

/// A line of what the system says of this process, in bytes.
fn status_bytes(name: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name))?;
    line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_is_seen_after_it_is_past() {
        let (kept, building) = Building::measure(|| {
            let large = vec![1u8; 64 << 20];
            Ok::<_, ()>(std::hint::black_box(large).iter().map(|&byte| u64::from(byte)).sum::<u64>())
        })
        .unwrap();
        assert_eq!(kept, 64 << 20);
        assert!(building.seconds > 0.0);
        assert!(building.processor_seconds > 0.0 && building.processor_seconds < 60.0, "{building:?}");
        // Other tests of this process take and free memory of their own meanwhile, but not as much.
        assert!(building.peak_bytes.is_none_or(|bytes| bytes > 32 << 20), "{building:?}");
    }
}
