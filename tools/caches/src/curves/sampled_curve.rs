//! A miss curve from a sample of the lines, and how far it may be off.

use super::TraceCounts;

/// The fewest lines that may stand for a cache.
pub const LEAST_MODEL: f64 = 100.0;

/// Samples that the sample is split into for its error bar.
pub(super) const PARTS: usize = 8;

/// 0.975 quantile of Student's t with `PARTS` - 1 degrees of freedom (any table of the distribution).
const STUDENT: f64 = 2.364_624;

/// What fully associative LRU caches would fetch, as far as a sample of the lines tells.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledCurve {
    /// What is the same for all sizes; these counts are exact.
    pub trace: TraceCounts,
    /// Share of the lines that is sampled.
    pub rate: f64,
    /// By lines of the sample, from one on; those beyond the end are as the last.
    pub(super) misses: Vec<u64>,
    pub(super) parts: Vec<Vec<u64>>,
}

/// An estimate and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Lines fetched.
    pub fetches: f64,
    /// Half the width of the 95 % interval, from the spread of the parts of the sample.
    pub error: f64,
}

impl SampledCurve {
    /// The least cache, in lines, that there are estimates for.
    #[must_use]
    pub fn least(&self) -> u64 {
        (LEAST_MODEL / self.rate).ceil() as u64
    }

    /// Lines fetched by a cache of so many lines; `None` below [`least`](Self::least).
    #[must_use]
    pub fn fetches(&self, lines: u64) -> Option<Estimate> {
        (lines >= self.least()).then(|| self.unchecked(lines))
    }

    /// The same for any size, however wrong: for showing how wrong.
    pub(super) fn unchecked(&self, lines: u64) -> Estimate {
        let at = |misses: &[u64], rate: f64| {
            let held = ((lines as f64 * rate).ceil() as usize).max(1);
            misses[(held - 1).min(misses.len() - 1)] as f64 / rate
        };
        let estimates: Vec<f64> = self.parts.iter().map(|part| at(part, self.rate / PARTS as f64)).collect();
        let mean = estimates.iter().sum::<f64>() / PARTS as f64;
        let variance = estimates.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (PARTS - 1) as f64;
        Estimate { fetches: at(&self.misses, self.rate), error: STUDENT * (variance / PARTS as f64).sqrt() }
    }

    /// Sizes in lines to print: the least that there is an estimate for, and each twice the one before, up to the map's.
    #[must_use]
    pub fn sizes(&self, lines_of_map: u64) -> Vec<u64> {
        std::iter::successors(Some(self.least()), |lines| lines.checked_mul(2))
            .take_while(|&lines| lines <= lines_of_map)
            .collect()
    }
}
