//! Student's t distribution.

use libm::{exp, fabs, lgamma, log, log1p, sqrt};
use std::f64::consts::PI;

/// So many degrees of freedom and more are the normal distribution, to seven digits; the fraction below converges the slower
/// the more there are.
const ENDLESS: f64 = 1e7;

/// The chance that Student's t with `freedom` degrees of freedom (any positive number) lies between `-t` and `t`.
#[must_use]
pub fn student_within(t: f64, freedom: f64) -> f64 {
    let (square, freedom) = (t * t, freedom.min(ENDLESS));
    1.0 - regularised_beta(freedom / (freedom + square), square / (freedom + square), freedom / 2.0, 0.5)
}

/// The `t` that Student's t with `freedom` degrees of freedom exceeds in size with chance 1 - `confidence`: half the
/// width of an interval, in standard errors. Not a number without degrees of freedom.
#[must_use]
pub fn student_quantile(confidence: f64, freedom: f64) -> f64 {
    if freedom.is_nan() || freedom <= 0.0 || !(0.0..1.0).contains(&confidence) {
        return f64::NAN;
    }
    let mut above = 1.0;
    while student_within(above, freedom) < confidence {
        above *= 2.0;
        if above > 1e300 {
            return f64::INFINITY;
        }
    }
    // Bisection: a bit in each round, and no more can be told apart than there are.
    let mut below = 0.0;
    for _ in 0..80 {
        let middle = (below + above) / 2.0;
        if student_within(middle, freedom) < confidence {
            below = middle;
        } else {
            above = middle;
        }
    }
    (below + above) / 2.0
}

/// The regularised incomplete beta function I_x(a, b), where `y` is 1 - x without its rounding error.
///
/// DLMF 8.17.22 gives the continued fraction, good where x is below (a + 1) / (a + b + 2); elsewhere 8.17.4 is used,
/// I_x(a, b) = 1 - I_y(b, a).
fn regularised_beta(x: f64, y: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if y <= 0.0 {
        return 1.0;
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - regularised_beta(y, x, b, a);
    }
    let ln_x = if y < 0.5 { log1p(-y) } else { log(x) };
    let ln_y = if x < 0.5 { log1p(-x) } else { log(y) };
    exp(a * ln_x + b * ln_y - ln_beta(a, b)) / a * beta_fraction(x, a, b)
}

/// The logarithm of the beta function. For large `a` and b = 1/2 the difference of two large logarithms is taken by the
/// asymptotic series of their ratio, DLMF 5.11.13.
fn ln_beta(a: f64, b: f64) -> f64 {
    let large = a.max(b);
    if a.min(b) == 0.5 && large > 1e4 {
        // Gamma(a + 1/2) / Gamma(a) = sqrt(a) (1 - 1/(8a) + 1/(128 a^2) + ...).
        let ratio = sqrt(large) * (1.0 - 1.0 / (8.0 * large) + 1.0 / (128.0 * large * large));
        return log(PI) / 2.0 - log(ratio);
    }
    lgamma(a) + lgamma(b) - lgamma(a + b)
}

/// 1 / (1 + d1 / (1 + d2 / (1 + ...))) of DLMF 8.17.22, by Lentz's method as Thompson and Barnett changed it.
fn beta_fraction(x: f64, a: f64, b: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let nonzero = |value: f64| if fabs(value) < TINY { TINY } else { value };
    let (mut fraction, mut c, mut d) = (1.0, 0.0, 0.0);
    // The first step, of coefficient 1, is the 1 above the line.
    let mut coefficient = 1.0;
    for step in 0..10_000 {
        d = 1.0 / nonzero(1.0 + coefficient * d);
        c = if step == 0 { 1.0 / TINY } else { nonzero(1.0 + coefficient / c) };
        let change = if step == 0 { d } else { c * d };
        fraction *= change;
        if step > 0 && fabs(change - 1.0) < 1e-15 {
            break;
        }
        let m = f64::from(step / 2);
        coefficient = if step % 2 == 0 {
            -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
        } else {
            let m = m + 1.0;
            m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m))
        };
    }
    fraction
}

#[cfg(test)]
mod tests;
