//! What pixels take of cached irradiance.

use super::gradients::{Coefficients, coefficients};
use crate::film::{Film, Overflow};
use pm_formats::{IrradianceRecord, PixelWeight};

/// Sums kept for each record: irradiance, change by rotation and by translation along x, y, z.
pub const TERMS: u32 = 7;

/// The records of a stream, and what each ray adds to their sums.
pub struct CachedIrradiance {
    records: Vec<IrradianceRecord>,
    coefficients: Vec<Vec<Coefficients>>,
    weights: Vec<PixelWeight>,
}

impl CachedIrradiance {
    /// Takes what stood beside the queries. Without `gradients` irradiance is taken as it is at the record.
    ///
    /// `None` if a weight speaks of a record that is not there or of a pixel beyond `pixels`.
    #[must_use]
    pub fn new(
        records: Vec<IrradianceRecord>,
        weights: Vec<PixelWeight>,
        pixels: u64,
        gradients: bool,
    ) -> Option<Self> {
        let known = |weight: &PixelWeight| (weight.record as usize) < records.len() && u64::from(weight.pixel) < pixels;
        if !weights.iter().all(known) {
            return None;
        }
        let coefficients = records
            .iter()
            .map(|record| {
                let mut all = coefficients(record);
                if !gradients {
                    all.iter_mut().for_each(|ray| {
                        ray.rotation = glam::Vec3::ZERO;
                        ray.translation = glam::Vec3::ZERO;
                    });
                }
                all
            })
            .collect();
        Some(Self { records, coefficients, weights })
    }

    /// True if the stream has no cached irradiance.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// Number of sums a film must hold for the records.
    #[must_use]
    pub fn sums(&self) -> usize {
        self.records.len() * TERMS as usize
    }

    /// What the radiance found for a ray adds to its record's sums: (number of the sum, what to add); `None` if there is
    /// no such ray.
    #[must_use]
    pub fn contributions(&self, record: u32, sample: u32, radiance: [f64; 3]) -> Option<[(u32, [f64; 3]); 7]> {
        let ray = self.coefficients.get(record as usize)?.get(sample as usize)?;
        let [r, t] = [ray.rotation, ray.translation];
        let factors = [ray.irradiance, r.x, r.y, r.z, t.x, t.y, t.z];
        Some(std::array::from_fn(|term| (record * TERMS + term as u32, radiance.map(|x| x * f64::from(factors[term])))))
    }

    /// Adds the light that rays met in mirrors and through glass to the records' sums.
    ///
    /// # Errors
    /// [`Overflow`].
    pub fn add_lights(&self, sums: &mut Film) -> Result<(), Overflow> {
        for (record, number) in self.records.iter().zip(0..) {
            for (ray, sample) in record.rays.iter().zip(0..).filter(|(ray, _)| ray.light != [0.0; 3]) {
                let radiance = ray.light.map(f64::from);
                for (sum, value) in self.contributions(number, sample, radiance).into_iter().flatten() {
                    sums.add(sum, sums.quantise(value).ok_or(Overflow(record.pixel))?)?;
                }
            }
        }
        Ok(())
    }

    /// Adds to `pixels` what each takes of the records, whose sums are complete.
    pub fn interpolate(&self, sums: &Film, pixels: &mut [[f32; 3]]) {
        let sums = sums.pixels();
        for weight in &self.weights {
            let terms = &sums[(weight.record * TERMS) as usize..][..TERMS as usize];
            let pixel = &mut pixels[weight.pixel as usize];
            for channel in 0..3 {
                let along =
                    |from: usize, by: [f32; 3]| (0..3).map(|axis| terms[from + axis][channel] * by[axis]).sum::<f32>();
                let irradiance = terms[0][channel] + along(1, weight.normal_change) + along(4, weight.displacement);
                // A gradient can overshoot where light is as good as gone.
                pixel[channel] += weight.weight[channel] * irradiance.max(0.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_formats::IrradianceRay;

    fn record() -> IrradianceRecord {
        let ray = IrradianceRay { length: 1.0, light: [0.0; 3] };
        IrradianceRecord {
            pixel: 0,
            position: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
            radius: 1.0,
            strata: [4, 4],
            rays: vec![ray; 16],
        }
    }

    fn weight(pixel: u32, record: u32) -> PixelWeight {
        PixelWeight { pixel, record, weight: [0.5, 1.0, 0.0], displacement: [0.1, 0.0, 0.0], normal_change: [0.0; 3] }
    }

    #[test]
    fn even_radiance_gives_its_irradiance_to_every_pixel() {
        let cached =
            CachedIrradiance::new(vec![record()], vec![weight(0, 0), weight(1, 0), weight(1, 0)], 2, true).unwrap();
        let mut sums = Film::new(cached.sums(), 1.0);
        for sample in 0..16 {
            for (sum, value) in cached.contributions(0, sample, [2.0, 1.0, 3.0]).unwrap() {
                sums.add(sum, sums.quantise(value).unwrap()).unwrap();
            }
        }
        let mut pixels = vec![[0f32; 3]; 2];
        cached.interpolate(&sums, &mut pixels);
        let pi = std::f32::consts::PI;
        for (pixel, expected) in pixels.iter().zip([[pi, pi, 0.0], [2.0 * pi, 2.0 * pi, 0.0]]) {
            assert!((0..3).all(|i| (pixel[i] - expected[i]).abs() < 1e-4), "{pixel:?} {expected:?}");
        }
    }

    #[test]
    fn weights_without_a_record_or_a_pixel_are_refused() {
        assert!(CachedIrradiance::new(vec![record()], vec![weight(0, 1)], 2, true).is_none());
        assert!(CachedIrradiance::new(vec![record()], vec![weight(2, 0)], 2, true).is_none());
        let cached = CachedIrradiance::new(vec![record()], vec![], 2, true).unwrap();
        assert!(cached.contributions(1, 0, [1.0; 3]).is_none() && cached.contributions(0, 16, [1.0; 3]).is_none());
    }
}
