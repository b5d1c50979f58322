//! One size of a curve.

use pm_caches::{CacheConfig, Curve, Estimate, SampledCurve, TraceCounts, Ways};
use std::rc::Rc;

/// One size of a curve: exact, from a sample of the lines, or both.
#[derive(Clone)]
pub(super) struct CurvePoint {
    /// The name of the trace's file, as it was typed.
    pub(super) file: Rc<str>,
    /// The photon map, if it is a trace of one.
    pub(super) map: Rc<str>,
    /// The order of the queries.
    pub(super) order: String,
    /// Searches in flight at a time.
    pub(super) lanes: u16,
    /// The commands that the trace came by.
    pub(super) history: Rc<str>,
    pub(super) exact: Option<Rc<Curve>>,
    /// Where the cliff of the exact curve ends, in lines: found once, not for every size.
    pub(super) cliff: Option<u64>,
    pub(super) sampled: Option<Rc<SampledCurve>>,
    pub(super) trace: TraceCounts,
    /// The size in lines.
    pub(super) lines: u64,
}

impl CurvePoint {
    /// The cache, as `--cache` would have it.
    pub(super) fn cache(&self) -> String {
        let config = CacheConfig::lru(self.bytes(), Ways::Full, self.trace.line_bytes);
        config.map_or_else(|error| error.to_string(), |config| config.to_string())
    }

    pub(super) fn bytes(&self) -> u64 {
        self.bytes_of(self.lines)
    }

    pub(super) fn bytes_of(&self, lines: u64) -> u64 {
        lines.saturating_mul(self.trace.line_bytes.into())
    }

    pub(super) fn fetches(&self) -> Option<u64> {
        Some(self.exact.as_ref()?.fetches(self.lines))
    }

    pub(super) fn write_backs(&self) -> Option<u64> {
        Some(self.exact.as_ref()?.write_backs(self.lines))
    }

    pub(super) fn estimate(&self) -> Option<Estimate> {
        self.sampled.as_ref()?.fetches(self.lines)
    }

    /// Fetches, exact if they are known so.
    pub(super) fn best(&self) -> f64 {
        let exact = self.fetches().map(|fetches| fetches as f64);
        exact.or_else(|| Some(self.estimate()?.fetches)).unwrap_or(f64::NAN)
    }

    pub(super) fn traffic(&self) -> f64 {
        match (self.fetches(), self.write_backs()) {
            (Some(fetches), Some(written)) => self.bytes_of(fetches + written) as f64,
            _ => f64::NAN,
        }
    }

    /// What is remarkable about the size.
    pub(super) fn mark(&self) -> &'static str {
        let Some(exact) = &self.exact else { return "" };
        match () {
            () if self.cliff == Some(self.lines) => "cliff",
            () if exact.last() == self.lines => "all",
            () => "",
        }
    }
}
