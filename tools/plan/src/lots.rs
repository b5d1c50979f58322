//! Noise of photons, from many small maps that have nothing in common.
//!
//! Photons err in large lumps: more of them than usual on one wall make a whole side of the picture too bright. Two maps tell the
//! mean of such noise badly, however many pixels are compared, and runs of one recipe differ by it. So the photons of a survey are
//! dealt out to J maps, all seen by the same two sets of rays A and B. Of map i, d_i is how far its picture is from the mean of
//! all. With <> the weighted mean over pixels, and C the covariance of pixels that one map's photons cause,
//!
//! * <d_iA, d_iB> has the mean tr C (J - 1) / J: the square of the noise, without that of rays, which A and B do not share;
//! * <d_iA, d_jB> <d_iB, d_jA> of i other than j has the mean tr C^2, but for what the mean of all takes away.
//!
//! The noise of one map is thus a sum of squares with (tr C)^2 / tr C^2 degrees of freedom, and its relative variance from map to
//! map is twice the inverse of that.

use crate::Estimate;
use crate::replicates::{Values, Weights, mean};
use pm_sampling::Spread;

/// Pictures of one map by both sets of rays.
pub(crate) type OfLot<'a> = [&'a Values; 2];

/// The noise of the photons of one lot.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PhotonNoise {
    /// Its square, the mean over pixels.
    pub(crate) square: Estimate,
    /// Its relative variance from one map to the next.
    pub(crate) lumps: f64,
}

impl PhotonNoise {
    /// From pictures of two maps or more.
    pub(crate) fn of(weights: &Weights, lots: &[OfLot<'_>]) -> Self {
        let number = lots.len() as f64;
        let means = [0, 1].map(|set: usize| mean(lots.iter().map(|lot| lot[set])));
        let product = |i: usize, j: usize| weights.products([lots[i][0], &means[0]], [lots[j][1], &means[1]]);
        let mut by_pixel = vec![0.0; means[0].len()];
        for i in 0..lots.len() {
            let unbiased = 1.0 / (number - 1.0);
            by_pixel.iter_mut().zip(product(i, i)).for_each(|(sum, one)| *sum += one * unbiased);
        }
        let square = Estimate::mean(&by_pixel);
        let of_pair = |i: usize, j: usize| product(i, j).iter().sum::<f64>() / by_pixel.len().max(1) as f64;
        let (mut squares, mut pairs) = (0.0, 0.0);
        for i in 0..lots.len() {
            for j in 0..i {
                squares += of_pair(i, j) * of_pair(j, i);
                pairs += 1.0;
            }
        }
        // The deviations of all lots sum to nothing: each pair has the mean -tr C / J.
        let apart = squares / pairs - square.value * square.value / (number * number);
        let lumps =
            if square.value > 0.0 { (2.0 * apart / (square.value * square.value)).clamp(0.0, 2.0) } else { 0.0 };
        let freedom = number - 1.0;
        let of_lots = Spread { variance: lumps * square.value * square.value / freedom, freedom };
        Self { square: Estimate { spread: square.spread.plus(of_lots), ..square }, lumps }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    const PIXELS: usize = 400;
    const SEEDS: u64 = 300;

    /// Pictures of lots whose noise is made of so many patches, each pixel with noise of rays beside it.
    fn found(patches: usize, seed: u64) -> PhotonNoise {
        let mut random = Random::new(&[seed]);
        let mut normal = || (0..12).map(|_| f64::from(random.unit())).sum::<f64>() - 6.0;
        let mut lots: Vec<[Values; 2]> = vec![];
        for _ in 0..16 {
            let lumps: Vec<f64> = (0..patches).map(|_| 0.1 * normal()).collect();
            let mut picture = || (0..PIXELS).map(|p| [1.0 + lumps[p * patches / PIXELS] + 0.2 * normal(); 3]).collect();
            lots.push([picture(), picture()]);
        }
        let weights = Weights::of(&vec![[1.0; 3]; PIXELS]);
        PhotonNoise::of(&weights, &lots.iter().map(|[a, b]| [a, b]).collect::<Vec<_>>())
    }

    #[test]
    fn lumps_are_told_from_fine_noise_and_from_noise_of_rays() {
        for (patches, expected) in [(1, 2.0), (4, 0.5), (40, 0.05)] {
            let all: Vec<PhotonNoise> = (0..SEEDS).map(|seed| found(patches, seed)).collect();
            let mean = |of: fn(&PhotonNoise) -> f64| all.iter().map(of).sum::<f64>() / SEEDS as f64;
            let (square, lumps) = (mean(|one| one.square.value), mean(|one| one.lumps));
            assert!((square - 0.01 / 1.01).abs() < 0.0012, "{patches}: {square}");
            assert!((lumps / expected - 1.0).abs() < 0.25, "{patches}: {lumps}, not {expected}");
            // What is said of the square holds: it differs from seed to seed as its spread says.
            let apart =
                all.iter().map(|one| libm::pow(one.square.value - square, 2.0)).sum::<f64>() / (SEEDS - 1) as f64;
            let said = mean(|one| one.square.spread.variance);
            assert!((0.7..1.5).contains(&(apart / said)), "{patches}: {apart} beside {said}");
        }
    }
}
