//! Ratios and totals estimated from windows, one of each stratum, and the variance of such estimates.

use super::{CONFIDENCE, student_quantile};

/// The variance of an estimate, and how well it is itself known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// The variance; the square of the standard error.
    pub variance: f64,
    /// Degrees of freedom of the variance; 0 where it cannot be known, as of a single window.
    pub freedom: f64,
}

impl Spread {
    /// The variance of the sum of `residuals`, which come from one window in each stratum, in the order of the strata.
    ///
    /// One window says nothing of the spread within its stratum, so strata are collapsed: neighbours pair up, an odd one
    /// out makes a triple with the last pair, and what differs within a group estimates the spread within its strata, and
    /// on the safe side, since what differs between the strata adds to it (Wolter, *Introduction to Variance Estimation*,
    /// 2007, section 2.5). A group of n adds n / (n - 1) sum (e - mean)^2, for a pair the square of the difference.
    ///
    /// Degrees of freedom are Satterthwaite's (*An approximate distribution of estimates of variance components*, 1946)
    /// with what he neglects: the square of a group variance v of n - 1 degrees of freedom is v^2 (n - 1) / (n + 1) without
    /// bias, and the square of their sum is too large by twice that. They are no more than those of all groups together.
    #[must_use]
    pub fn of_sum(residuals: &[f64]) -> Self {
        let (mut variance, mut squares, mut most) = (0.0, 0.0, 0.0);
        let mut rest = residuals;
        while rest.len() >= 2 {
            let (group, later) = rest.split_at(if rest.len() == 3 { 3 } else { 2 });
            rest = later;
            let n = group.len() as f64;
            let mean = group.iter().sum::<f64>() / n;
            let of_group = group.iter().map(|e| (e - mean) * (e - mean)).sum::<f64>() * n / (n - 1.0);
            variance += of_group;
            squares += of_group * of_group * (n - 1.0) / (n + 1.0);
            most += n - 1.0;
        }
        let freedom = if squares > 0.0 { (variance * variance / squares - 2.0).clamp(1.0, most) } else { most };
        Self { variance, freedom }
    }

    /// The spread of the estimate times `factor`.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { variance: self.variance * factor * factor, ..self }
    }

    /// The spread of the sum of two independent estimates.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let variance = self.variance + other.variance;
        let share = |part: Self| if part.variance > 0.0 { part.variance * part.variance / part.freedom } else { 0.0 };
        let squares = share(self) + share(other);
        let freedom = if squares > 0.0 { variance * variance / squares } else { self.freedom + other.freedom };
        Self { variance, freedom }
    }

    /// Half the width of the interval that holds the truth 95 times of 100; not a number where the spread is not known.
    #[must_use]
    pub fn half_width(self) -> f64 {
        student_quantile(CONFIDENCE, self.freedom) * libm::sqrt(self.variance)
    }
}

/// A ratio of two sums over the windows of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ratio {
    /// The ratio; not a number if nothing is below the line.
    pub value: f64,
    /// The sum below the line, by which ratios of several samples are weighted.
    pub weight: f64,
    /// How far the ratio may be off by chance.
    pub spread: Spread,
    /// How far it may be off beside, as what is above the line is known between bounds only. No number of windows makes it
    /// less.
    pub doubt: f64,
}

impl Ratio {
    /// The ratio of the sums of `above` and `below`, of one window in each stratum, in the order of the strata.
    ///
    /// Its variance is that of the sum of the residuals `above - value * below`, over the square of the sum below
    /// (Cochran, *Sampling Techniques*, 1977, section 6.10: the combined ratio estimate).
    #[must_use]
    pub fn of(above: &[f64], below: &[f64]) -> Self {
        let weight = below.iter().sum::<f64>();
        let value = above.iter().sum::<f64>() / weight;
        let residuals: Vec<f64> = above.iter().zip(below).map(|(above, below)| above - value * below).collect();
        Self { value, weight, spread: Spread::of_sum(&residuals).scaled(1.0 / weight), doubt: 0.0 }
    }

    /// The same where of each `most` above the line as much as `unknown` may be nothing: the middle of the bounds.
    #[must_use]
    pub fn between(most: &[f64], unknown: &[f64], below: &[f64]) -> Self {
        let middle: Vec<f64> = most.iter().zip(unknown).map(|(most, unknown)| most - unknown / 2.0).collect();
        let ratio = Self::of(&middle, below);
        Self { doubt: unknown.iter().sum::<f64>() / 2.0 / ratio.weight, ..ratio }
    }

    /// The sum of all strata, of whose whole the windows are a `share`.
    #[must_use]
    pub fn total(most: &[f64], unknown: &[f64], share: f64) -> Self {
        let middle: Vec<f64> = most.iter().zip(unknown).map(|(most, unknown)| most - unknown / 2.0).collect();
        Self {
            value: middle.iter().sum::<f64>() / share,
            weight: share,
            spread: Spread::of_sum(&middle).scaled(1.0 / share),
            doubt: unknown.iter().sum::<f64>() / 2.0 / share,
        }
    }

    /// A ratio as a table has it: with half the width of its interval, of which `doubt` is a part. Nothing is known of the
    /// spread without degrees of freedom.
    #[must_use]
    pub fn of_interval(value: f64, weight: f64, half_width: f64, doubt: f64, freedom: f64) -> Self {
        let error = (half_width - doubt) / student_quantile(CONFIDENCE, freedom);
        let spread = if freedom > 0.0 { Spread { variance: error * error, freedom } } else { Spread::default() };
        Self { value, weight, spread, doubt }
    }

    /// The ratio of two samples drawn independently, as of one: weighted by what each has below the line.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        let weight = self.weight + other.weight;
        let (mine, its) = (self.weight / weight, other.weight / weight);
        Self {
            value: self.value * mine + other.value * its,
            weight,
            spread: self.spread.scaled(mine).plus(other.spread.scaled(its)),
            doubt: self.doubt * mine + other.doubt * its,
        }
    }

    /// Half the width of the interval that holds the truth 95 times of 100: what chance and doubt make of it.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        self.spread.half_width() + self.doubt
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-12 * b.abs().max(1.0)
    }

    #[test]
    fn pairs_and_a_triple_by_hand() {
        // (1 - 3)^2, then 3/2 of the squares about the mean 4 of 2, 4 and 6.
        let spread = Spread::of_sum(&[1.0, 3.0, 2.0, 4.0, 6.0]);
        assert!(close(spread.variance, 4.0 + 1.5 * 8.0), "{spread:?}");
        // 16^2 / (4^2 / 3 + 12^2 / 2) - 2.
        assert!(close(spread.freedom, 256.0 / (16.0 / 3.0 + 72.0) - 2.0), "{spread:?}");
        assert!(close(Spread::of_sum(&[1.0, 4.0]).variance, 9.0));
        assert!(close(Spread::of_sum(&[1.0, 4.0]).freedom, 1.0));
        // No more than there are pairs.
        assert!(close(Spread::of_sum(&[0.0, 1.0].repeat(50)).freedom, 50.0));
        assert_eq!(Spread::of_sum(&[5.0]), Spread::default());
        assert!(Spread::of_sum(&[5.0]).half_width().is_nan());
    }

    #[test]
    fn a_ratio_by_hand() {
        let ratio = Ratio::of(&[2.0, 6.0], &[1.0, 3.0]);
        assert!(close(ratio.value, 2.0) && close(ratio.weight, 4.0) && close(ratio.spread.variance, 0.0));
        let ratio = Ratio::of(&[2.0, 7.0], &[1.0, 2.0]);
        // Residuals -1 and 1: variance 4 over 3^2.
        assert!(close(ratio.value, 3.0) && close(ratio.spread.variance, 4.0 / 9.0));
        assert!(close(ratio.spread.half_width(), libm::tan(0.475 * std::f64::consts::PI) * 2.0 / 3.0));
    }

    #[test]
    fn what_is_unknown_is_halved() {
        let (most, unknown, below) = ([4.0, 10.0, 7.0], [2.0, 0.0, 1.0], [1.0, 2.0, 2.0]);
        let ratio = Ratio::between(&most, &unknown, &below);
        assert_eq!(Ratio { doubt: 0.0, ..ratio }, Ratio::of(&[3.0, 10.0, 6.5], &below));
        assert!(close(ratio.doubt, 1.5 / 5.0) && close(ratio.value - ratio.doubt, 18.0 / 5.0));
        let total = Ratio::total(&most, &unknown, 0.1);
        assert!(close(total.value, 195.0) && close(total.doubt, 15.0));
        assert!(close(total.spread.variance, 100.0 * Spread::of_sum(&[3.0, 10.0, 6.5]).variance));
    }

    #[test]
    fn a_ratio_is_known_from_its_interval() {
        let ratio = Ratio::between(&[4.0, 10.0, 7.0, 8.0], &[2.0, 0.0, 1.0, 0.0], &[1.0, 2.0, 2.0, 3.0]);
        let Ratio { value, weight, spread, doubt } = ratio;
        let again = Ratio::of_interval(value, weight, ratio.half_width(), doubt, spread.freedom);
        assert!(close(again.spread.variance, spread.variance) && again.spread.freedom == spread.freedom);
        assert_eq!((again.value, again.weight, again.doubt), (value, weight, doubt));
        let unknown = Ratio::of_interval(value, weight, f64::NAN, doubt, 0.0);
        assert!(unknown.spread == Spread::default() && unknown.half_width().is_nan());
    }

    #[test]
    fn samples_put_together_are_weighted_by_size() {
        let one = Ratio { value: 1.0, weight: 3.0, spread: Spread { variance: 4.0, freedom: 9.0 }, doubt: 0.4 };
        let other = Ratio { value: 5.0, weight: 1.0, spread: Spread { variance: 16.0, freedom: 4.0 }, doubt: 0.8 };
        let both = one.with(other);
        assert!(close(both.value, 2.0) && close(both.weight, 4.0) && close(both.doubt, 0.5));
        assert!(close(both.half_width(), both.spread.half_width() + 0.5));
        assert!(close(both.spread.variance, 4.0 * 9.0 / 16.0 + 1.0));
        assert!(close(both.spread.freedom, 3.25 * 3.25 / (2.25 * 2.25 / 9.0 + 0.25)));
    }

    /// A number that is normal enough: the sum of twelve.
    fn normal(random: &mut Random) -> f64 {
        (0..12).map(|_| f64::from(random.unit())).sum::<f64>() - 6.0
    }

    #[test]
    fn satterthwaite_is_about_right_for_equal_pairs() {
        let (pairs, trials) = (40, 4000);
        let mut random = Random::new(&[5]);
        let freedom: f64 = (0..trials)
            .map(|_| Spread::of_sum(&(0..2 * pairs).map(|_| normal(&mut random)).collect::<Vec<_>>()).freedom)
            .sum::<f64>()
            / f64::from(trials);
        // What is above 40 is cut off.
        assert!((33.0..40.0).contains(&freedom), "{freedom}");
    }

    /// A population of cells in strata: what each has above and below the line. It trends, wobbles, and is skewed.
    fn population(strata: usize, cells: usize, seed: u64) -> Vec<Vec<(f64, f64)>> {
        let mut random = Random::new(&[seed]);
        (0..strata)
            .map(|stratum| {
                let level = 50.0 + 20.0 * (stratum as f64 / 9.0).sin();
                (0..cells)
                    .map(|_| {
                        let below = 150.0 + f64::from(random.unit()) * 106.0;
                        (below * (level + 40.0 * f64::from(random.unit()).powi(3)), below)
                    })
                    .collect()
            })
            .collect()
    }

    #[test]
    fn intervals_hold_the_truth_of_a_population_made_up() {
        for (strata, least) in [(10, 0.93), (41, 0.935), (120, 0.935)] {
            let population = population(strata, 30, 9);
            let all: Vec<(f64, f64)> = population.iter().flatten().copied().collect();
            let truth = all.iter().map(|cell| cell.0).sum::<f64>() / all.iter().map(|cell| cell.1).sum::<f64>();
            let seeds = 2000;
            let (mut held, mut widths, mut squares) = (0, 0.0, 0.0);
            for seed in 0..seeds {
                let mut random = Random::new(&[77, seed]);
                let chosen: Vec<(f64, f64)> =
                    population.iter().map(|cells| cells[random.next_u64() as usize % cells.len()]).collect();
                let (above, below): (Vec<f64>, Vec<f64>) = chosen.into_iter().unzip();
                let ratio = Ratio::of(&above, &below);
                held += u32::from((ratio.value - truth).abs() <= ratio.spread.half_width());
                widths += ratio.spread.half_width() / seeds as f64;
                squares += (ratio.value - truth).powi(2) / seeds as f64;
            }
            let share = f64::from(held) / seeds as f64;
            assert!((least..0.985).contains(&share), "{strata} strata: {share}");
            // Not wider than need be: 1.96 standard errors, more where there are few degrees of freedom.
            let wide = widths / (1.96 * squares.sqrt());
            assert!((0.9..if strata > 20 { 1.3 } else { 1.6 }).contains(&wide), "{strata} strata: {wide}");
        }
    }
}
