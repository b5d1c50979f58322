//! The radiance estimate: flux of the nearest photons per area of the disc that holds them.
//!
//! Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 7.2, with the constant kernel.

use crate::photon_map::Nearest;
use pm_formats::{Bounds, Material, Photon, Query};
use std::f64::consts::PI;

/// How the photons found become a radiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Estimator {
    /// The k-th photon sets the radius and is not summed: unbiased where photons are spread evenly
    Unbiased,
    /// All k photons are summed, as in the textbook: k/(k-1) too bright for ever
    Classic,
}

/// What became of a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// Radiance towards the viewer, linear RGB, times the query's weight.
    Radiance([f64; 3]),
    /// The nearest photons all lie at the query's own point, so that their disc has no area: nothing can be said.
    NoArea,
}

/// What the sum needs of a photon.
#[derive(Clone, Copy)]
struct Flux {
    /// Flux times the number of emitted paths: mantissas of 8 bits, so exact.
    power: [f32; 3],
    /// Surface normal in steps of 1/127.
    normal: [i8; 3],
}

/// Estimates radiance from the photons of one map.
pub struct RadianceEstimate<'a> {
    photons: Vec<Flux>,
    materials: &'a [Material],
    emitted_paths: f64,
    max_dist: f32,
    estimator: Estimator,
    /// Double-precision sums of k powers are exact, hence the same in any order.
    exact_sums: bool,
}

/// Photons whose surface is turned farther than this from the query's are left out of the sum: they lie round a corner
/// or on the other side. The cosine of 26 degrees: well beyond the 2 degrees that the packed normal may be off.
const MIN_NORMAL_COSINE: f32 = 0.9;

impl<'a> RadianceEstimate<'a> {
    /// Prepares estimates from `photons`, whose flux is theirs divided by `emitted_paths`, with searches for `k` of them
    /// within `max_dist`.
    #[must_use]
    pub fn new(
        photons: &[Photon],
        materials: &'a [Material],
        emitted_paths: u64,
        k: usize,
        max_dist: f32,
        estimator: Estimator,
    ) -> Self {
        // Each power is an 8-bit mantissa times 2^exponent. As long as the exponents span few enough bits, a double's 53
        // hold every partial sum exactly.
        let exponents = || photons.iter().map(|photon| u32::from(photon.power[3])).filter(|&exponent| exponent > 0);
        let span = exponents().max().unwrap_or(0) - exponents().min().unwrap_or(0);
        let exact_sums = span + 8 + usize::BITS - k.leading_zeros() <= 53;
        #[expect(clippy::cast_possible_truncation, reason = "8-bit mantissas and |components| <= 1")]
        let flux = |photon: &Photon| Flux {
            power: photon.power().map(|x| x as f32),
            normal: photon.normal().map(|x| (x * 127.0).round() as i8),
        };
        #[expect(clippy::cast_precision_loss, reason = "path counts stay below 2^53")]
        let emitted_paths = emitted_paths.max(1) as f64;
        Self { photons: photons.iter().map(flux).collect(), materials, emitted_paths, max_dist, estimator, exact_sums }
    }

    /// What `query` adds to its pixel, given the photons found for it.
    #[must_use]
    pub fn contribution(&self, query: &Query, found: &Nearest, scratch: &mut Vec<(u32, f32)>) -> Outcome {
        let farthest = found.farthest();
        // The photon that sets the radius, and the squared radius. Where the limit cuts the search short it sets the
        // radius itself and all photons count; with no limit, the farthest of the few photons there are does.
        let (rim, radius_squared) = match farthest {
            Some((distance, id)) if found.is_full() || self.max_dist.is_infinite() => (Some(id), distance),
            _ => (None, self.max_dist * self.max_dist),
        };
        let rim = rim.filter(|_| self.estimator == Estimator::Unbiased);
        if radius_squared.is_nan() || radius_squared <= 0.0 {
            return if found.is_empty() { Outcome::Radiance([0.0; 3]) } else { Outcome::NoArea };
        }
        let flux = self.flux(query, found, rim, scratch);
        let area = PI * f64::from(radius_squared);
        let material = &self.materials[usize::from(query.material)];
        let radiance = [0, 1, 2].map(|channel| {
            let irradiance = flux[channel] / (area * self.emitted_paths);
            f64::from(query.weight[channel]) * (f64::from(material.diffuse[channel]) / PI) * irradiance
        });
        Outcome::Radiance(radiance)
    }

    /// Sum of the powers that arrive on the query's side of its surface, `rim` left out.
    fn flux(&self, query: &Query, found: &Nearest, rim: Option<u32>, scratch: &mut Vec<(u32, f32)>) -> [f64; 3] {
        let normal = query.normal();
        let counts = |id: u32| {
            let n = self.photons[id as usize].normal;
            let cosine = f32::from(n[0]) * normal[0] + f32::from(n[1]) * normal[1] + f32::from(n[2]) * normal[2];
            cosine > MIN_NORMAL_COSINE * 127.0 && Some(id) != rim
        };
        let mut sum = [0f64; 3];
        let mut add = |id: u32| {
            let power = self.photons[id as usize].power;
            (0..3).for_each(|channel| sum[channel] += f64::from(power[channel]));
        };
        if self.exact_sums {
            found.iter().filter(|&(_, id)| counts(id)).for_each(|(_, id)| add(id));
        } else {
            // Rounded sums depend on their order: then it is that of the ids, whatever order they were found in.
            scratch.clear();
            scratch.extend(found.iter().filter(|&(_, id)| counts(id)).map(|(distance, id)| (id, distance)));
            scratch.sort_unstable_by_key(|&(id, _)| id);
            scratch.iter().for_each(|&(id, _)| add(id));
        }
        sum
    }

    /// Radiance that the photons' flux suggests for a scene of these bounds: the scale for a [`Film`](crate::film::Film).
    #[must_use]
    pub fn scale(&self, bounds: &Bounds) -> f64 {
        let mut flux = [0f64; 3];
        for photon in &self.photons {
            (0..3).for_each(|channel| flux[channel] += f64::from(photon.power[channel]) / self.emitted_paths);
        }
        let side = |axis: usize| f64::from(bounds.max[axis]) - f64::from(bounds.min[axis]);
        flux.into_iter().fold(0.0, f64::max) / (0..3).map(|axis| side(axis) * side(axis)).sum::<f64>()
    }
}
