//! What is seen of a picture, and how far it is from what is seen of another.

use super::colours::{TO_XYZ, adjusted_lab, from_opponent, hyab, to_opponent};
use super::filters::{Filters, Plane};
use crate::Picture;

/// Exponent of the colour difference, q_c.
const COLOUR_EXPONENT: f32 = 0.7;
/// Differences up to this share of the largest, p_c, take the share p_t of the scale.
const COLOUR_KNEE: [f32; 2] = [0.4, 0.95];
/// What is seen of a picture: colours as the eye resolves them, in L a b adjusted for Hunt's effect, and the strength of
/// edges and points.
pub(super) struct Seen {
    colours: Vec<[f32; 3]>,
    features: [Vec<f32>; 2],
}

impl Seen {
    pub(super) fn new(picture: &Picture, filters: &Filters, tone: impl Fn(f32) -> f32) -> Self {
        let shown = |pixel: &[f32; 3]| finite(*pixel).map(|x| tone(x).clamp(0.0, 1.0));
        let opponent: Vec<[f32; 3]> = picture.pixels.iter().map(|pixel| to_opponent(shown(pixel))).collect();
        let width = picture.size[0] as usize;
        let plane = |channel: usize| Plane { width, values: opponent.iter().map(|pixel| pixel[channel]).collect() };
        let resolved = [0, 1, 2].map(|channel| {
            let parts = filters.eye[channel].iter().filter(|(share, _)| *share > 0.0);
            parts.fold(vec![0f32; opponent.len()], |mut sum, (share, kernel)| {
                let part = plane(channel).filtered(kernel, kernel);
                sum.iter_mut().zip(part.values).for_each(|(sum, x)| *sum += share * x);
                sum
            })
        });
        // Rows of the table are columns of the transposed matrix.
        let to_rgb = glam::DMat3::from_cols_array_2d(&TO_XYZ).transpose().inverse();
        let colours = (0..opponent.len()).map(|i| {
            let rgb = from_opponent([resolved[0][i], resolved[1][i], resolved[2][i]], &to_rgb);
            adjusted_lab(rgb.map(|x| x.clamp(0.0, 1.0)))
        });
        let grey = Plane { width, values: opponent.iter().map(|pixel| (pixel[0] + 16.0) / 116.0).collect() };
        let features = [0, 1].map(|which| {
            let derivative = &filters.derivatives[which];
            let across = grey.filtered(derivative, &filters.gaussian);
            let down = grey.filtered(&filters.gaussian, derivative);
            across.values.iter().zip(&down.values).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        });
        Self { colours: colours.collect(), features }
    }
}

/// FLIP of each pixel (section 4.3).
pub(super) fn difference(reference: &Seen, test: &Seen) -> Vec<f32> {
    assert_eq!(reference.colours.len(), test.colours.len(), "pictures of different sizes");
    // The largest difference there is: between green and blue.
    let most = libm::powf(hyab(adjusted_lab([0.0, 1.0, 0.0]), adjusted_lab([0.0, 0.0, 1.0])), COLOUR_EXPONENT);
    let [knee, share] = COLOUR_KNEE;
    let knee = knee * most;
    (0..reference.colours.len())
        .map(|i| {
            let colour = libm::powf(hyab(reference.colours[i], test.colours[i]), COLOUR_EXPONENT);
            let colour = match colour < knee {
                true => colour * share / knee,
                false => share + (colour - knee) / (most - knee) * (1.0 - share),
            };
            let feature = |which: usize| (reference.features[which][i] - test.features[which][i]).abs();
            let feature = (feature(0).max(feature(1)) * std::f32::consts::FRAC_1_SQRT_2).clamp(0.0, 1.0).sqrt();
            libm::powf(colour, 1.0 - feature).clamp(0.0, 1.0)
        })
        .collect()
}

/// A pixel, black if it is not finite.
pub(super) fn finite(pixel: [f32; 3]) -> [f32; 3] {
    if pixel.iter().all(|x| x.is_finite()) { pixel } else { [0.0; 3] }
}
