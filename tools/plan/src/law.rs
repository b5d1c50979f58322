//! Bias as a power of the search area, extrapolated to none.
//!
//! The k nearest of n photons lie within an area in proportion to x = k / n. What a radius blurs goes with a power of it: with x
//! where radiance is smooth, with the root of x at edges. What can be measured is how far k of n differ from fewer photons of
//! more, of x0: of this difference, c (x^g - x0^g), squares are measured, and c and g are fitted.

use crate::Estimate;

/// The square of a difference, measured.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Photons searched for, of all photons: k / n.
    pub x: f64,
    /// The mean over pixels of the square of the difference to the picture of the least x.
    pub square: Estimate,
}

/// The law of bias: its square at x is `scale` x^(2 `power`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Law {
    /// The square of the bias at x = 1.
    pub scale: Estimate,
    /// The power of x.
    pub power: f64,
}

/// What is thought of the power before anything is measured: between edges and smooth light, and how far to either side.
const USUAL: (f64, f64) = (0.75, 0.25);
/// Powers that are tried, in hundredths.
const POWERS: std::ops::RangeInclusive<u32> = 30..=120;

impl Law {
    /// Fits the law to points that are measured against a picture of `least`.
    #[must_use]
    pub fn fit(points: &[Point], least: f64) -> Self {
        let points: Vec<&Point> = points.iter().filter(|point| point.x > least * 1.001).collect();
        if points.is_empty() {
            return Self::default();
        }
        let fits = POWERS.step_by(2).map(|hundredths| Self::with_power(f64::from(hundredths) / 100.0, &points, least));
        fits.min_by(|a, b| a.1.total_cmp(&b.1)).map_or_else(Self::default, |(law, _)| law)
    }

    /// The law of this power that fits best, and how badly it does.
    fn with_power(power: f64, points: &[&Point], least: f64) -> (Self, f64) {
        let far = |x: f64| libm::pow(libm::pow(x, power) - libm::pow(least, power), 2.0);
        let weight = |point: &Point| 1.0 / point.square.spread.variance.max(f64::MIN_POSITIVE);
        let above: f64 = points.iter().map(|point| weight(point) * far(point.x) * point.square.value).sum();
        let below: f64 = points.iter().map(|point| weight(point) * far(point.x) * far(point.x)).sum();
        let scale = if below > 0.0 { (above / below).max(0.0) } else { 0.0 };
        let misfit = |point: &&Point| {
            let off = point.square.value - scale * far(point.x);
            weight(point) * off * off
        };
        let surprise = libm::pow((power - USUAL.0) / USUAL.1, 2.0);
        // All points are of the same rays and photons: together they tell no more than one of them.
        let n = points.len() as f64;
        let freedom = points.iter().map(|point| point.square.spread.freedom).sum::<f64>() / n;
        let variance = if below > 0.0 { n / below } else { 0.0 };
        let scale = Estimate { value: scale, spread: pm_sampling::Spread { variance, freedom } };
        (Self { scale, power }, points.iter().map(misfit).sum::<f64>() / n + surprise)
    }

    /// The square of the bias with k of n photons, x of them.
    #[must_use]
    pub fn at(&self, x: f64) -> Estimate {
        self.scale.scaled(libm::pow(x, 2.0 * self.power))
    }

    /// By what the square of the difference between x and `least` is to be multiplied to be the square of the bias at x.
    #[must_use]
    pub fn extrapolation(&self, x: f64, least: f64) -> f64 {
        1.0 / libm::pow(1.0 - libm::pow(least / x, self.power), 2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_sampling::Spread;

    fn points(power: f64, scale: f64, noise: f64) -> Vec<Point> {
        let x = |level: i32| 1e-5 * f64::from(1 << level);
        let square = |x: f64| scale * libm::pow(libm::pow(x, power) - libm::pow(1e-5, power), 2.0);
        let point = |level: i32| Point {
            x: x(level),
            square: Estimate { value: square(x(level)), spread: Spread { variance: noise * noise, freedom: 100.0 } },
        };
        (0..8).map(point).collect()
    }

    #[test]
    fn a_law_that_is_there_is_found() {
        for (power, scale) in [(0.5, 2.0), (1.0, 5000.0)] {
            let law = Law::fit(&points(power, scale, 1e-9), 1e-5);
            assert!((law.power - power).abs() < 0.011, "{law:?}");
            // What was measured against is itself biased: at the least radius too.
            let (found, expected) = (law.at(1e-5).value, scale * libm::pow(1e-5, 2.0 * power));
            assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
            let between = law.extrapolation(8e-5, 1e-5) * points(power, scale, 1.0)[3].square.value;
            assert!((between / law.at(8e-5).value - 1.0).abs() < 0.02);
        }
    }

    #[test]
    fn what_is_not_seen_stays_in_doubt() {
        // Nothing is measured, give or take 1e-6: the law says none, and may be off by as much.
        let law = Law::fit(&points(0.75, 0.0, 1e-6), 1e-5);
        let largest = law.at(1e-5 * 128.0);
        assert!(largest.value == 0.0 && largest.upper(0.95) > 1e-6, "{largest:?}");
        assert_eq!(Law::fit(&[], 1.0), Law::default());
    }
}
