//! How far a picture is from another that it should agree with.

use crate::{Picture, PictureError, Result};

/// Keeps the relative error of dark pixels finite: the usual choice where relMSE is reported (Rousselle, Knaus, Zwicker:
/// *Adaptive Sampling and Reconstruction using Greedy Error Minimization*, SIGGRAPH Asia 2011).
pub const REL_MSE_EPSILON: f64 = 0.01;

/// Measures of the difference between a reference a and a picture b, over all channels of all pixels that are finite in
/// both. Of no pixels they are not numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Number of pixels.
    pub pixels: u64,
    /// Pixels left out because a channel is infinite or no number in one of the pictures.
    pub not_finite: u64,
    /// Pixels whose bits differ (0 and -0 do not).
    pub differing: u64,
    /// Mean of b divided by mean of a, by channel; not a number where a is black.
    pub ratio: [f64; 3],
    /// Root of the mean squared difference, in radiance.
    pub rmse: f64,
    /// Mean of (b - a)^2 / (a^2 + [`REL_MSE_EPSILON`]).
    pub rel_mse: f64,
    /// Mean absolute difference, in radiance.
    pub mae: f64,
    /// Largest absolute difference, in radiance.
    pub largest: f64,
}

impl Comparison {
    /// Compares `b` with the reference `a`.
    ///
    /// # Errors
    /// If they are not of the same size.
    pub fn new(a: &Picture, b: &Picture) -> Result<Self> {
        if a.size != b.size {
            return Err(PictureError::SizesDiffer(a.size, b.size));
        }
        let finite = |pixel: &[f32; 3]| pixel.iter().all(|x| x.is_finite());
        let (mut compared, mut differing, mut not_finite) = (0u64, 0, 0);
        let (mut sums, mut squares, mut relative, mut absolute, mut largest) = ([[0f64; 3]; 2], 0.0, 0.0, 0.0, 0f64);
        for (x, y) in a.pixels.iter().zip(&b.pixels) {
            differing += u64::from((0..3).any(|c| x[c] != y[c] && x[c].to_bits() != y[c].to_bits()));
            if !finite(x) || !finite(y) {
                not_finite += 1;
                continue;
            }
            compared += 1;
            for channel in 0..3 {
                let [x, y] = [x, y].map(|pixel| f64::from(pixel[channel]));
                let difference = y - x;
                sums[0][channel] += x;
                sums[1][channel] += y;
                squares += difference * difference;
                relative += difference * difference / (x * x + REL_MSE_EPSILON);
                absolute += difference.abs();
                largest = largest.max(difference.abs());
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "pictures have fewer than 2^50 pixels")]
        let samples = (compared * 3) as f64;
        let ratio =
            |channel: usize| if sums[0][channel] == 0.0 { f64::NAN } else { sums[1][channel] / sums[0][channel] };
        Ok(Self {
            pixels: a.pixels.len() as u64,
            not_finite,
            differing,
            ratio: [ratio(0), ratio(1), ratio(2)],
            rmse: (squares / samples).sqrt(),
            rel_mse: relative / samples,
            mae: absolute / samples,
            largest,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(values: &[f32]) -> Picture {
        Picture { size: [values.len() as u32, 1], pixels: values.iter().map(|&x| [x; 3]).collect() }
    }

    fn near(x: f64, expected: f64) {
        assert!((x - expected).abs() <= 1e-6 * expected.abs(), "{x}, not {expected}");
    }

    #[test]
    fn one_per_cent_more_light() {
        let of = |scale: f32| Picture { size: [2, 1], pixels: vec![[1.0, 2.0, 0.5].map(|x| x * scale); 2] };
        let comparison = Comparison::new(&of(1.0), &of(1.01)).unwrap();
        comparison.ratio.into_iter().for_each(|ratio| near(ratio, 1.01));
        // Differences 0.01, 0.02, 0.005.
        assert!((comparison.rmse / (5.25e-4f64 / 3.0).sqrt() - 1.0).abs() < 1e-4);
        let relative = 1e-4 / 1.01 + 4e-4 / 4.01 + 0.25e-4 / 0.26;
        assert!((comparison.rel_mse / (relative / 3.0) - 1.0).abs() < 1e-4);
        assert!((comparison.mae / (0.035 / 3.0) - 1.0).abs() < 1e-4);
        assert!((comparison.largest / 0.02 - 1.0).abs() < 1e-4);
        assert_eq!((comparison.pixels, comparison.differing, comparison.not_finite), (2, 2, 0));
    }

    #[test]
    fn signs_cancel_in_the_ratio_only() {
        let comparison = Comparison::new(&grey(&[1.0, 1.0, 1.0, 1.0]), &grey(&[1.5, 0.5, 1.0, 1.0])).unwrap();
        assert_eq!(comparison.ratio, [1.0; 3]);
        assert_eq!((comparison.mae, comparison.largest, comparison.differing), (0.25, 0.5, 2));
        near(comparison.rmse, 0.125f64.sqrt());
        near(comparison.rel_mse, 0.125 / 1.01);
    }

    #[test]
    fn what_is_not_finite_is_counted_and_left_out() {
        let comparison = Comparison::new(&grey(&[1.0, f32::NAN, 2.0]), &grey(&[1.0, 5.0, f32::INFINITY])).unwrap();
        assert_eq!((comparison.not_finite, comparison.differing, comparison.rmse), (2, 2, 0.0));
        let black = Comparison::new(&grey(&[0.0]), &grey(&[-0.0])).unwrap();
        assert!(black.ratio[0].is_nan() && black.differing == 0);
        assert!(Comparison::new(&grey(&[0.0]), &grey(&[0.0, 0.0])).is_err());
    }
}
