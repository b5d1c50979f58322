//! Exposures of radiance, and the curve by which a screen shows it.

use super::colours::TO_XYZ;
use super::seen::finite;
use crate::Picture;

/// Coefficients of the tone curve (a x^2 + b x) / (c x^2 + d x + e): Narkowicz's fit of the ACES filmic curve, darkened
/// by 0.6 as the authors do.
const FILMIC: [f64; 5] = [0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14];

#[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
pub(super) fn filmic(x: f32) -> f32 {
    let [a, b, c, d, e] = FILMIC.map(|x| x as f32);
    // Beyond this the curve is flat, and its squares are no numbers at last.
    let x = x.min(1e9);
    (x * (a * x + b)) / (x * (c * x + d) + e)
}

/// First and last exposure in stops, and the number of exposures: the brightest luminance, and the median, become 0.85.
pub(super) fn exposures(reference: &Picture) -> ([f64; 2], u32) {
    const SHOWN: f64 = 0.85;
    let [a, b, c, d, e] = FILMIC;
    let (a, b, c) = (a - SHOWN * c, b - SHOWN * d, -SHOWN * e);
    let brightest = (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
    let luminance = |pixel: &[f32; 3]| -> f64 {
        (0..3).map(|c| TO_XYZ[1][c] * f64::from(finite(*pixel)[c].max(0.0))).sum::<f64>().max(1e-6)
    };
    let mut luminances: Vec<f64> = reference.pixels.iter().map(luminance).collect();
    luminances.sort_unstable_by(f64::total_cmp);
    let [median, most] = [luminances.len() / 2, luminances.len().saturating_sub(1)]
        .map(|index| luminances.get(index).copied().unwrap_or(1.0));
    let ends = [most, median].map(|luminance| libm::log2(brightest / luminance));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred stops at most")]
    let count = (ends[1] - ends[0]).ceil().max(2.0) as u32;
    (ends, count)
}
