//! How many windows an interval as narrow as asked takes.

use super::Ratio;

/// Asks for windows until an interval is narrow enough: a pilot, then what its spread says is missing, as Stein has it
/// (*A two-sample test for a linear hypothesis whose power is independent of the variance*, 1945) and SMARTS after him
/// (Wunderlich, Wenisch, Falsafi, Hoe, ISCA 2003, section 5.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Half the width of the interval asked for, as a share of the value.
    pub until: f64,
    /// Windows of the pilot.
    pub pilot: u64,
}

/// So many more windows than needed are asked for, as a share: the spread of those to come is not that of those seen, and
/// a further round costs more than they do.
const MARGIN: f64 = 0.05;

/// The least number of windows of a round: enough for a spread of its own to be known.
const LEAST_ROUND: u64 = 8;

impl Tuning {
    /// How many windows are to be added to `windows` that gave `ratio`; none if its interval is narrow enough, or if so much
    /// is in doubt that no number of windows makes it so.
    #[must_use]
    pub fn missing(&self, windows: u64, ratio: &Ratio) -> u64 {
        if windows == 0 {
            return self.pilot;
        }
        let left = self.until * ratio.value - ratio.doubt;
        let wide = ratio.spread.half_width() / left;
        if wide <= 1.0 || left <= 0.0 {
            return 0;
        }
        if !wide.is_finite() {
            return windows;
        }
        // The width goes with one over the root of the number.
        let wanted = libm::ceil(windows as f64 * wide * wide * (1.0 + MARGIN)) as u64;
        (wanted - windows).max(LEAST_ROUND)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Spread;
    use super::*;

    #[test]
    fn twice_as_wide_takes_four_times_as_many() {
        let tuning = Tuning { until: 0.01, pilot: 100 };
        let ratio = |width: f64| {
            // So many degrees of freedom that t is the normal distribution's.
            let spread = Spread { variance: (width / 1.959_964_f64).powi(2), freedom: 1e9 };
            Ratio { value: 50.0, weight: 1.0, spread, doubt: 0.0 }
        };
        assert_eq!(tuning.missing(0, &Ratio::default()), 100);
        assert_eq!(tuning.missing(100, &ratio(0.499)), 0);
        assert_eq!(tuning.missing(100, &ratio(0.501)), 8);
        assert!((319..=321).contains(&tuning.missing(100, &ratio(1.0))));
        assert_eq!(tuning.missing(100, &Ratio { value: 1.0, ..Ratio::default() }), 100);
        // Half of the width is left to chance, then nothing.
        assert!((319..=321).contains(&tuning.missing(100, &Ratio { doubt: 0.25, ..ratio(0.5) })));
        assert_eq!(tuning.missing(100, &Ratio { doubt: 0.5, ..ratio(0.5) }), 0);
    }
}
