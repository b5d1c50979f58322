//! FLIP: how different two pictures look to an eye that flips between them.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: *FLIP: A Difference Evaluator for Alternating
//! Images*, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020, for pictures as a screen shows them; Andersson, Nilsson,
//! Shirley, Akenine-Möller: *Visualizing Errors in Rendered High Dynamic Range Images*, Eurographics 2021 (short papers),
//! for radiance: the largest difference over all exposures that show something of the reference. Section and symbol names
//! are those of the first.

use super::Picture;
use std::f64::consts::PI;

/// Pixels that a degree of the field of view holds: a screen of 3840 pixels and 0.7 m across, seen from 0.7 m.
pub const PIXELS_PER_DEGREE: f64 = 67.020_6;

/// Exponent of the colour difference, q_c.
const COLOUR_EXPONENT: f32 = 0.7;
/// Differences up to this share of the largest, p_c, take the share p_t of the scale.
const COLOUR_KNEE: [f32; 2] = [0.4, 0.95];
/// Width of the feature detector in degrees, w.
const FEATURE_WIDTH: f64 = 0.082;
/// The eye's sensitivity to contrast in each channel of Y Cx Cz: amplitudes and scales of two Gaussians (table 1).
const SENSITIVITY: [[[f64; 2]; 2]; 3] =
    [[[1.0, 0.0047], [0.0, 1e-5]], [[1.0, 0.0053], [0.0, 1e-5]], [[34.1, 0.04], [13.5, 0.025]]];
/// Linear Rec. 709 RGB to XYZ.
const TO_XYZ: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

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
    let filters = Filters::new(pixels_per_degree);
    let [reference, test] = [reference, test].map(|picture| Seen::new(picture, &filters, |x| x));
    mean(&difference(&reference, &test))
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

/// Coefficients of the tone curve (a x^2 + b x) / (c x^2 + d x + e): Narkowicz's fit of the ACES filmic curve, darkened
/// by 0.6 as the authors do.
const FILMIC: [f64; 5] = [0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14];

#[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
fn filmic(x: f32) -> f32 {
    let [a, b, c, d, e] = FILMIC.map(|x| x as f32);
    // Beyond this the curve is flat, and its squares are no numbers at last.
    let x = x.min(1e9);
    (x * (a * x + b)) / (x * (c * x + d) + e)
}

/// First and last exposure in stops, and the number of exposures: the brightest luminance, and the median, become 0.85.
fn exposures(reference: &Picture) -> ([f64; 2], u32) {
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

fn finite(pixel: [f32; 3]) -> [f32; 3] {
    if pixel.iter().all(|x| x.is_finite()) { pixel } else { [0.0; 3] }
}

/// One channel of a picture.
struct Plane {
    width: usize,
    values: Vec<f32>,
}

impl Plane {
    /// Filtered by a kernel across and one down; what lies outside is as the nearest pixel inside.
    fn filtered(&self, across: &[f32], down: &[f32]) -> Self {
        let (width, height) = (self.width, self.values.len() / self.width.max(1));
        let mut rows = vec![0f32; self.values.len()];
        let radius = across.len() / 2;
        let mut padded = vec![0f32; width + 2 * radius];
        for (row, filtered) in self.values.chunks_exact(width).zip(rows.chunks_exact_mut(width)) {
            padded[..radius].fill(row[0]);
            padded[radius..radius + width].copy_from_slice(row);
            padded[radius + width..].fill(row[width - 1]);
            for (x, value) in filtered.iter_mut().enumerate() {
                *value = across.iter().zip(&padded[x..]).map(|(weight, x)| weight * x).sum();
            }
        }
        let mut values = vec![0f32; self.values.len()];
        let radius = down.len() / 2;
        for (y, filtered) in values.chunks_exact_mut(width).enumerate() {
            for (index, weight) in down.iter().enumerate() {
                let from = (y + index).saturating_sub(radius).min(height - 1);
                for (value, x) in filtered.iter_mut().zip(&rows[from * width..(from + 1) * width]) {
                    *value += weight * x;
                }
            }
        }
        Self { width, values }
    }
}

/// The kernels for a resolution. All are products of one across and one down.
struct Filters {
    /// What the eye resolves in each channel of Y Cx Cz: shares and kernels of two Gaussians (section 4.1).
    eye: [[(f32, Vec<f32>); 2]; 3],
    /// Edges and points: a derivative one way, a Gaussian the other (section 4.2).
    gaussian: Vec<f32>,
    derivatives: [Vec<f32>; 2],
}

impl Filters {
    fn new(pixels_per_degree: f64) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "a few pixels")]
        let kernel = |radius: f64, weight: &dyn Fn(f64) -> f64| -> Vec<f64> {
            let radius = radius.ceil() as i32;
            (-radius..=radius).map(|x| weight(f64::from(x))).collect()
        };
        #[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
        let scaled = |kernel: &[f64], scale: &dyn Fn(f64) -> f64| -> Vec<f32> {
            kernel.iter().map(|&x| (x * scale(x)) as f32).collect()
        };
        // All as wide as the widest.
        let radius = 3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * pixels_per_degree;
        let eye = SENSITIVITY.map(|gaussians| {
            let kernels = gaussians
                .map(|[_, scale]| kernel(radius, &|x| libm::exp(-PI * PI * (x / pixels_per_degree).powi(2) / scale)));
            let sums = [0, 1].map(|i| kernels[i].iter().sum::<f64>());
            let shares = [0, 1].map(|i| gaussians[i][0] * (PI / gaussians[i][1]).sqrt() * sums[i] * sums[i]);
            #[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
            [0, 1].map(|i| ((shares[i] / (shares[0] + shares[1])) as f32, scaled(&kernels[i], &|_| 1.0 / sums[i])))
        });
        let deviation = 0.5 * FEATURE_WIDTH * pixels_per_degree;
        let gaussian = |x: f64| libm::exp(-x * x / (2.0 * deviation * deviation));
        let smooth = kernel(3.0 * deviation, &gaussian);
        let sum: f64 = smooth.iter().sum();
        let edge = kernel(3.0 * deviation, &|x| -x * gaussian(x));
        let point = kernel(3.0 * deviation, &|x| (x * x / (deviation * deviation) - 1.0) * gaussian(x));
        // What is positive adds up to 1, what is negative to -1.
        let derivatives = [edge, point].map(|kernel| {
            let part = |sign: f64| kernel.iter().map(|x| (x * sign).max(0.0)).sum::<f64>();
            let (above, below) = (part(1.0), part(-1.0));
            scaled(&kernel, &|x| 1.0 / if x > 0.0 { above } else { below })
        });
        Self { eye, gaussian: scaled(&smooth, &|_| 1.0 / sum), derivatives }
    }
}

/// What is seen of a picture: colours as the eye resolves them, in L a b adjusted for Hunt's effect, and the strength of
/// edges and points.
struct Seen {
    colours: Vec<[f32; 3]>,
    features: [Vec<f32>; 2],
}

impl Seen {
    fn new(picture: &Picture, filters: &Filters, tone: impl Fn(f32) -> f32) -> Self {
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
fn difference(reference: &Seen, test: &Seen) -> Vec<f32> {
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

/// Distance of colours far apart: by steps in lightness, as the crow flies in hue and chroma.
fn hyab(a: [f32; 3], b: [f32; 3]) -> f32 {
    (a[0] - b[0]).abs() + ((a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()
}

/// XYZ in units of white.
#[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
fn to_xyz(rgb: [f32; 3]) -> [f32; 3] {
    TO_XYZ.map(|row| {
        let white: f64 = row.iter().sum();
        ((0..3).map(|c| row[c] * f64::from(rgb[c])).sum::<f64>() / white) as f32
    })
}

/// Linear RGB to Y Cx Cz, a linear form of CIE L a b.
fn to_opponent(rgb: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = to_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[expect(clippy::cast_possible_truncation, reason = "a pixel's precision is enough")]
fn from_opponent([y, cx, cz]: [f32; 3], to_rgb: &glam::DMat3) -> [f32; 3] {
    let y = (y + 16.0) / 116.0;
    let shares = [y + cx / 500.0, y, y - cz / 200.0];
    let xyz = glam::DVec3::from_array([0, 1, 2].map(|i| f64::from(shares[i]) * TO_XYZ[i].iter().sum::<f64>()));
    (*to_rgb * xyz).to_array().map(|x| x as f32)
}

/// CIE L a b of a linear RGB colour, a and b scaled by L / 100: in the dark, colours differ less (Hunt).
fn adjusted_lab(rgb: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let [x, y, z] = to_xyz(rgb).map(|t| match t > DELTA * DELTA * DELTA {
        true => libm::cbrtf(t),
        false => t / (3.0 * DELTA * DELTA) + 4.0 / 29.0,
    });
    let lightness = 116.0 * y - 16.0;
    [lightness, 5.0 * lightness * (x - y), 2.0 * lightness * (y - z)]
}

#[cfg(test)]
mod tests;
