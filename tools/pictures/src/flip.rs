//! FLIP: how different two pictures look to an eye that flips between them.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: *FLIP: A Difference Evaluator for Alternating
//! Images*, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020, for pictures as a screen shows them; Andersson, Nilsson,
//! Shirley, Akenine-Möller: *Visualizing Errors in Rendered High Dynamic Range Images*, Eurographics 2021 (short papers),
//! for radiance: the largest difference over all exposures that show something of the reference. Section and symbol names
//! are those of the first.

mod colours;
mod exposures;
mod filters;
mod seen;

use crate::Picture;
use exposures::{exposures, filmic};
use filters::Filters;
use seen::{Seen, difference};

/// Pixels that a degree of the field of view holds: a screen of 3840 pixels and 0.7 m across, seen from 0.7 m.
pub const PIXELS_PER_DEGREE: f64 = 67.020_6;

/// A FLIP of radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HdrFlip {
    /// Mean over the pixels, 0 (the same) to 1.
    pub mean: f64,
    /// First and last exposure in stops, and their number.
    pub exposures: ([f64; 2], u32),
}

/// Mean FLIP of two pictures as a screen shows them: clipped to [0, 1].
///
/// # Panics
/// If they are not of the same size.
#[must_use]
pub fn ldr_flip(reference: &Picture, test: &Picture, pixels_per_degree: f64) -> f64 {
    mean(&ldr_flip_map(reference, test, pixels_per_degree))
}

/// The same pixel by pixel, 0 (the same) to 1.
///
/// # Panics
/// If they are not of the same size.
#[must_use]
pub fn ldr_flip_map(reference: &Picture, test: &Picture, pixels_per_degree: f64) -> Vec<f32> {
    let filters = Filters::new(pixels_per_degree);
    let [reference, test] = [reference, test].map(|picture| Seen::new(picture, &filters, |x| x));
    difference(&reference, &test)
}

/// Mean FLIP of the radiance of two pictures: in each pixel the largest over exposures a stop or less apart, from that
/// which shows the brightest pixel of the reference to that which shows its median. Pixels that are not finite are black.
///
/// # Panics
/// If they are not of the same size.
#[must_use]
pub fn hdr_flip(reference: &Picture, test: &Picture, pixels_per_degree: f64) -> HdrFlip {
    let filters = Filters::new(pixels_per_degree);
    let (ends, count) = exposures(reference);
    let mut largest = vec![0f32; reference.pixels.len()];
    for step in 0..count {
        let stops = ends[0] + (ends[1] - ends[0]) * f64::from(step) / f64::from(count - 1);
        #[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
        let scale = libm::exp2(stops) as f32;
        let seen = |picture| Seen::new(picture, &filters, |x| filmic(x.max(0.0) * scale));
        for (most, here) in largest.iter_mut().zip(difference(&seen(reference), &seen(test))) {
            *most = most.max(here);
        }
    }
    HdrFlip { mean: mean(&largest), exposures: (ends, count) }
}

fn mean(values: &[f32]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "pictures have fewer than 2^50 pixels")]
    let count = values.len() as f64;
    values.iter().map(|&x| f64::from(x)).sum::<f64>() / count
}

#[cfg(test)]
mod tests;
