//! What the eye resolves, and edges and points that it notices, as filters.

use std::f64::consts::PI;

/// Width of the feature detector in degrees, w.
const FEATURE_WIDTH: f64 = 0.082;
/// The eye's sensitivity to contrast in each channel of Y Cx Cz: amplitudes and scales of two Gaussians (table 1).
const SENSITIVITY: [[[f64; 2]; 2]; 3] =
    [[[1.0, 0.0047], [0.0, 1e-5]], [[1.0, 0.0053], [0.0, 1e-5]], [[34.1, 0.04], [13.5, 0.025]]];
/// One channel of a picture.
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) values: Vec<f32>,
}

impl Plane {
    /// Filtered by a kernel across and one down; what lies outside is as the nearest pixel inside.
    pub(super) fn filtered(&self, across: &[f32], down: &[f32]) -> Self {
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
pub(super) struct Filters {
    /// What the eye resolves in each channel of Y Cx Cz: shares and kernels of two Gaussians (section 4.1).
    pub(super) eye: [[(f32, Vec<f32>); 2]; 3],
    /// Edges and points: a derivative one way, a Gaussian the other (section 4.2).
    pub(super) gaussian: Vec<f32>,
    pub(super) derivatives: [Vec<f32>; 2],
}

impl Filters {
    pub(super) fn new(pixels_per_degree: f64) -> Self {
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
