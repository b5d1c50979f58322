//! How many windows an interval as narrow as asked takes: the rule that `pm-sweep until` runs, and whose coverage is measured.

use super::Ratio;

/// Asks for windows until an interval is narrow enough: a pilot, then what its spread says is missing, as Stein has it
/// (*A two-sample test for a linear hypothesis whose power is independent of the variance*, 1945) and SMARTS after him
/// (Wunderlich, Wenisch, Falsafi, Hoe, ISCA 2003, section 5.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Half the width of the interval asked for, as a share of the value; without it, the pilot is all.
    pub until: Option<f64>,
    /// Windows of the pilot.
    pub pilot: u64,
    /// No more windows than these.
    pub most: Option<u64>,
}

/// So many more windows than needed are asked for, as a share: the spread of those to come is not that of those seen, and
/// a further round costs more than they do.
const MARGIN: f64 = 0.05;

/// The least number of windows of a round: enough for a spread of its own to be known.
const LEAST_ROUND: u64 = 8;

/// What is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// Nothing: the interval is as narrow as asked.
    Nothing,
    /// So many windows.
    Windows(u64),
    /// So much is in doubt that no number of windows makes the interval as narrow.
    Certainty,
}

impl Tuning {
    /// What is missing to `windows` that gave `ratio`.
    #[must_use]
    pub fn missing(&self, windows: u64, ratio: &Ratio) -> Missing {
        let Some(until) = self.until else { return Missing::Nothing };
        let left = until * ratio.value - ratio.doubt;
        let chance = ratio.spread.half_width();
        if chance <= left {
            return Missing::Nothing;
        }
        if left <= 0.0 {
            return Missing::Certainty;
        }
        let wide = chance / left;
        if !wide.is_finite() {
            return Missing::Windows(windows);
        }
        // The width goes with one over the root of the number.
        let wanted = libm::ceil(windows as f64 * wide * wide * (1.0 + MARGIN)) as u64;
        Missing::Windows((wanted - windows).max(LEAST_ROUND))
    }

    /// A sample of no windows yet.
    #[must_use]
    pub const fn begin(self) -> Sample {
        Sample { tuning: self, rounds: 0, windows: 0, ratio: None }
    }
}

/// Windows to be drawn together, as a sample by itself: by a seed that no other round has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Round {
    /// Its number, from 0.
    pub number: u64,
    /// How many windows.
    pub windows: u64,
}

/// A sample that grows in rounds. Which windows a round has depends on nothing found before but by their number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    tuning: Tuning,
    rounds: u64,
    windows: u64,
    ratio: Option<Ratio>,
}

impl Sample {
    /// The next round; none if the sample is all that is asked for, or all that may be.
    #[must_use]
    pub fn next_round(&self) -> Option<Round> {
        let missing = match self.missing() {
            Missing::Windows(windows) => windows,
            Missing::Nothing | Missing::Certainty => return None,
        };
        let windows = missing.min(self.tuning.most.map_or(u64::MAX, |most| most.saturating_sub(self.windows)));
        (windows > 0).then_some(Round { number: self.rounds, windows })
    }

    /// Adds what a round told.
    pub fn add(&mut self, round: Round, ratio: Ratio) {
        self.rounds += 1;
        self.windows += round.windows;
        self.ratio = Some(self.ratio.map_or(ratio, |before| before.with(ratio)));
    }

    /// What is missing.
    #[must_use]
    pub fn missing(&self) -> Missing {
        self.ratio.map_or(Missing::Windows(self.tuning.pilot), |ratio| self.tuning.missing(self.windows, &ratio))
    }

    /// What all rounds together tell; none before the first.
    #[must_use]
    pub const fn ratio(&self) -> Option<Ratio> {
        self.ratio
    }

    /// Windows of all rounds.
    #[must_use]
    pub const fn windows(&self) -> u64 {
        self.windows
    }
}

#[cfg(test)]
mod tests {
    use super::super::Spread;
    use super::*;

    fn ratio(width: f64) -> Ratio {
        // So many degrees of freedom that t is the normal distribution's.
        let spread = Spread { variance: (width / 1.959_964_f64).powi(2), freedom: 1e9 };
        Ratio { value: 50.0, weight: 1.0, spread, doubt: 0.0 }
    }

    #[test]
    fn twice_as_wide_takes_four_times_as_many() {
        let tuning = Tuning { until: Some(0.01), pilot: 100, most: None };
        assert_eq!(tuning.missing(100, &ratio(0.499)), Missing::Nothing);
        assert_eq!(tuning.missing(100, &ratio(0.501)), Missing::Windows(8));
        let is_four = |missing| matches!(missing, Missing::Windows(319..=321));
        assert!(is_four(tuning.missing(100, &ratio(1.0))));
        assert_eq!(tuning.missing(100, &Ratio { value: 1.0, ..Ratio::default() }), Missing::Windows(100));
        // Half of the width is left to chance, then nothing.
        assert!(is_four(tuning.missing(100, &Ratio { doubt: 0.25, ..ratio(0.5) })));
        assert_eq!(tuning.missing(100, &Ratio { doubt: 0.5, ..ratio(0.5) }), Missing::Certainty);
        assert_eq!(Tuning { until: None, ..tuning }.missing(100, &ratio(9.0)), Missing::Nothing);
    }

    #[test]
    fn a_sample_grows_until_it_is_narrow_or_as_large_as_it_may_be() {
        let tuning = Tuning { until: Some(0.01), pilot: 100, most: Some(500) };
        let mut sample = tuning.begin();
        let pilot = sample.next_round().unwrap();
        assert_eq!(pilot, Round { number: 0, windows: 100 });
        sample.add(pilot, ratio(1.0));
        let second = sample.next_round().unwrap();
        assert!(second.number == 1 && (319..=321).contains(&second.windows), "{second:?}");
        // The second is as wide as the first, so that both are wider than asked, and 500 are all that may be.
        sample.add(second, ratio(1.0));
        let third = sample.next_round().unwrap();
        assert_eq!(third.windows, 500 - 100 - second.windows);
        sample.add(third, ratio(1.0));
        assert_eq!((sample.next_round(), sample.windows()), (None, 500));
        assert!(matches!(sample.missing(), Missing::Windows(_)));
        let both = ratio(1.0).with(ratio(1.0)).with(ratio(1.0));
        assert_eq!(sample.ratio(), Some(both));
        // A pilot alone, and one that is larger than it may be.
        let mut pilot_only = Tuning { until: None, pilot: 9, most: Some(5) }.begin();
        let round = pilot_only.next_round().unwrap();
        assert_eq!(round.windows, 5);
        pilot_only.add(round, ratio(1.0));
        assert_eq!(pilot_only.next_round(), None);
    }
}
