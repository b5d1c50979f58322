//! The radiance estimate: flux of the nearest photons per area of the disc that holds them.
//!
//! Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 7.2.

mod sum;

use super::disc::{Disc, Slope, Stranger};
use super::surface::{Surface, coarse, on_same_surface};
use super::{Edges, EstimateOptions, Estimator, Kernel, Outcome};
use glam::Vec3;
use pm_formats::{Bounds, Material, Photon, Query};
use pm_maps::Nearest;

/// What every sum needs of a photon.
#[derive(Clone, Copy)]
struct Flux {
    /// Flux times the number of emitted paths: mantissas of 8 bits, so exact.
    power: [f32; 3],
    /// Surface normal in steps of 1/127.
    normal: [i8; 3],
}

/// Estimates radiance from the photons of one map.
pub struct RadianceEstimate<'a> {
    flux: Vec<Flux>,
    photons: &'a [Photon],
    materials: &'a [Material],
    emitted_paths: f64,
    options: EstimateOptions,
    /// Double-precision sums of k powers are exact, hence the same in any order.
    exact_sums: bool,
}

/// Room for the photons of one query, used again for the next.
#[derive(Default)]
pub struct Scratch {
    /// On the query's own surface: id and squared distance.
    own: Vec<(u32, f32)>,
    strangers: Vec<Stranger>,
}

/// Cuts that leave less than this share of the disc are not made: next to no photon lies there, and where surfaces are a
/// tangle nothing may be left to divide by.
const LEAST_SHARE: f64 = 1.0 / 64.0;

impl<'a> RadianceEstimate<'a> {
    /// Prepares estimates from `photons`, whose flux is theirs divided by `emitted_paths`.
    #[must_use]
    pub fn new(photons: &'a [Photon], materials: &'a [Material], emitted_paths: u64, options: EstimateOptions) -> Self {
        // Each power is an 8-bit mantissa times 2^exponent. As long as the exponents span few enough bits, a double's 53
        // hold every partial sum exactly.
        let exponents = || photons.iter().map(|photon| u32::from(photon.power[3])).filter(|&exponent| exponent > 0);
        let span = exponents().max().unwrap_or(0) - exponents().min().unwrap_or(0);
        let exact_sums = span + 8 + usize::BITS - options.k.leading_zeros() <= 53;
        #[expect(clippy::cast_possible_truncation, reason = "8-bit mantissas")]
        let flux = |photon: &Photon| Flux { power: photon.power().map(|x| x as f32), normal: coarse(photon.normal()) };
        #[expect(clippy::cast_precision_loss, reason = "path counts stay below 2^53")]
        let emitted_paths = emitted_paths.max(1) as f64;
        Self { flux: photons.iter().map(flux).collect(), photons, materials, emitted_paths, options, exact_sums }
    }

    /// What `query` adds to its pixel, given the photons found for it.
    #[must_use]
    pub fn contribution(&self, query: &Query, found: &Nearest, scratch: &mut Scratch) -> Outcome {
        let Lit { surface, area, slope, .. } = match self.area(query.position, query.normal(), found, scratch) {
            Ok(known) => known,
            Err(Nothing::Dark) => return Outcome::Radiance([0.0; 3]),
            Err(Nothing::NoArea) => return Outcome::NoArea,
        };
        let material = &self.materials[usize::from(query.material)];
        let reflected = self.reflected(&surface, slope, query, material, &mut scratch.own);
        Outcome::Radiance(
            [0, 1, 2]
                .map(|channel| f64::from(query.weight[channel]) * reflected[channel] / (area * self.emitted_paths)),
        )
    }

    /// Irradiance at a point of a surface, in watts per square scene unit, given the photons found for it, and how far from
    /// there it tells of the same surface: most of their radius, or the distance of the nearest edge; `None` if their disc has no
    /// area.
    #[must_use]
    pub fn irradiance(
        &self,
        position: [f32; 3],
        normal: [f32; 3],
        found: &Nearest,
        scratch: &mut Scratch,
    ) -> Option<([f64; 3], f64)> {
        match self.area(position, normal, found, scratch) {
            Ok(Lit { surface, area, reach, slope }) => {
                let flux = self.sum(&surface, slope, None, &mut scratch.own);
                // Weights by slope may be negative, and so their sum; irradiance is not.
                Some((flux.map(|flux| flux.max(0.0) / (area * self.emitted_paths)), reach))
            }
            Err(Nothing::Dark) => Some(([0.0; 3], 0.0)),
            Err(Nothing::NoArea) => None,
        }
    }

    /// Leaves in `scratch.own` the photons that count, and says what area they light.
    fn area(
        &self,
        position: [f32; 3],
        normal: [f32; 3],
        found: &Nearest,
        scratch: &mut Scratch,
    ) -> Result<Lit, Nothing> {
        let EstimateOptions { max_dist, estimator, kernel, edges, .. } = self.options;
        // The photon that sets the radius, and the squared radius. Where the limit cuts the search short it sets the
        // radius itself and all photons count; with no limit, the farthest of the few photons there are does.
        let (rim, radius_squared) = match found.farthest() {
            Some((distance, id)) if found.is_full() || max_dist.is_infinite() => (Some(id), distance),
            _ => (None, max_dist * max_dist),
        };
        let rim = rim.filter(|_| estimator == Estimator::Unbiased);
        if radius_squared.is_nan() || radius_squared <= 0.0 {
            return Err(if found.is_empty() { Nothing::Dark } else { Nothing::NoArea });
        }
        let radius_squared = f64::from(radius_squared);
        let surface = Surface { position: Vec3::from(position).as_dvec3(), normal, radius: radius_squared.sqrt() };
        let whole = || Disc::new(Vec3::from(normal).as_dvec3());
        let mut disc = whole();
        self.sort_out(&surface, found, rim, scratch);
        let mut reach = disc.reach();
        // An edge that the disc of a limit reaches is as real as one that the k-th photon's does.
        if radius_squared.is_finite() && !scratch.strangers.is_empty() {
            disc.cut(&scratch.strangers);
            reach = disc.reach();
            if disc.integral(kernel) < LEAST_SHARE * kernel.disc() {
                disc = whole();
            }
            if !disc.is_whole() {
                scratch.own.retain(|&(id, _)| disc.holds(surface.offset(&self.photons[id as usize])));
            }
            // Light behind a wall does not count, whatever the area.
            if edges == Edges::Ignored {
                disc = whole();
            }
        }
        let slope = if edges == Edges::Sloped { Slope::of(&disc, kernel) } else { None };
        Ok(Lit { area: radius_squared * disc.integral(kernel), reach: reach * surface.radius, surface, slope })
    }

    /// Sorts the photons found into those of the query's surface and strangers; `rim` is not among the former.
    fn sort_out(&self, surface: &Surface, found: &Nearest, rim: Option<u32>, scratch: &mut Scratch) {
        scratch.own.clear();
        scratch.strangers.clear();
        for (distance, id) in found.iter() {
            if on_same_surface(self.flux[id as usize].normal, surface.normal) {
                if Some(id) != rim {
                    scratch.own.push((id, distance));
                }
            } else {
                let photon = &self.photons[id as usize];
                let normal = Vec3::from(photon.normal()).as_dvec3();
                scratch.strangers.push(Stranger { rank: (distance, id), offset: surface.offset(photon), normal });
            }
        }
    }

    /// Radiance that the photons' flux suggests for a scene of these bounds: the scale for a [`Film`](pm_film::film::Film).
    #[must_use]
    pub fn scale(&self, bounds: &Bounds) -> f64 {
        let mut flux = [0f64; 3];
        for photon in &self.flux {
            (0..3).for_each(|channel| flux[channel] += f64::from(photon.power[channel]) / self.emitted_paths);
        }
        let side = |axis: usize| f64::from(bounds.max[axis]) - f64::from(bounds.min[axis]);
        flux.into_iter().fold(0.0, f64::max) / (0..3).map(|axis| side(axis) * side(axis)).sum::<f64>()
    }
}

/// What photons light.
struct Lit {
    surface: Surface,
    /// Its area that they light, in square scene units, each part times the kernel's weight there.
    area: f64,
    /// As far as no edge is, in scene units.
    reach: f64,
    /// How photons weigh by where they are, if not all alike.
    slope: Option<Slope>,
}

/// Why there is no area that photons light.
enum Nothing {
    /// None was found.
    Dark,
    /// All were found at one point.
    NoArea,
}

#[cfg(test)]
mod tests;
