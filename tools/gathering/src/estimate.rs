//! The radiance estimate: flux of the nearest photons per area of the disc that holds them.
//!
//! Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 7.2.

mod placed;
mod plain;
mod shorts;
mod spread;
mod sum;

use super::disc::{Around, Disc, Slope, Stranger};
use super::surface::{Kin, Surface, on_same_surface};
use super::{Edges, EstimateOptions, Estimator, Kernel, Outcome};
use glam::Vec3;
use placed::{Placed, exponents};
use pm_formats::{Bounds, Material, Photon, Query};
use pm_maps::Nearest;
pub(crate) use spread::Spread;
use std::sync::Arc;

/// Estimates radiance from the photons of one map.
pub struct RadianceEstimate<'a> {
    photons: &'a [Photon],
    placed: Placed<'a>,
    materials: &'a [Material],
    /// The BRDF of each that is not glossy.
    diffuse: Vec<Option<[f64; 3]>>,
    emitted_paths: f64,
    options: EstimateOptions,
    /// Double-precision sums of k powers are exact, hence the same in any order.
    exact_sums: bool,
    /// What powers are small multiples of, where that is enough to know.
    short_unit: Option<f64>,
}

/// Room for the photons of one query, used again for the next.
#[derive(Default)]
pub struct Scratch {
    /// On the query's own surface: place and squared distance.
    own: Vec<(u32, f32)>,
    around: Around,
    kin: Kin,
    /// Had the query before photons of other surfaces about it?
    near_edge: bool,
    /// The normal of the query before, packed and unpacked.
    last: Option<(u32, [f32; 3])>,
}

impl Scratch {
    /// A query's normal, which often is that of the query before.
    #[inline]
    fn normal(&mut self, query: &Query) -> [f32; 3] {
        match self.last {
            Some((packed, normal)) if packed == query.normal => normal,
            _ => self.last.insert((query.normal, query.normal())).1,
        }
    }
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
        let (least, most) = exponents(photons);
        let exact_sums = u32::from(most - least) + 8 + usize::BITS - options.k.leading_zeros() <= 53;
        #[expect(clippy::cast_precision_loss, reason = "path counts stay below 2^53")]
        let emitted_paths = emitted_paths.max(1) as f64;
        let placed = Placed::by_id(photons);
        let diffuse = materials.iter().map(Self::diffuse_of).collect();
        let mut new =
            Self { photons, placed, materials, diffuse, emitted_paths, options, exact_sums, short_unit: None };
        new.short_unit = new.unit_of_short();
        new
    }

    /// The same, faster for a map that has its photons in this order ([`PhotonMap::order`](pm_maps::PhotonMap::order)).
    #[must_use]
    pub fn in_order(self, order: Option<&Arc<[u32]>>) -> Self {
        Self { placed: self.placed.in_order(order), ..self }
    }

    /// What `query` adds to its pixel, given the photons found for it.
    #[must_use]
    pub fn contribution(&self, query: &Query, found: &Nearest, scratch: &mut Scratch) -> Outcome {
        let normal = scratch.normal(query);
        let rim = match self.rim(found) {
            Ok(known) => known,
            Err(Nothing::Dark) => return Outcome::Radiance([0.0; 3]),
            Err(Nothing::NoArea) => return Outcome::NoArea,
        };
        // Next to a query near an edge is another, and what is asked of it is not the usual case.
        let plain = if scratch.near_edge { None } else { self.plain(&rim, normal, query.material, found) };
        let (reflected, area) = match plain {
            Some(known) => known,
            None => {
                let Lit { surface, area, slope, .. } = self.area(query.position, normal, &rim, found, scratch);
                let material = &self.materials[usize::from(query.material)];
                (self.reflected(&surface, slope, query, material, &mut scratch.own), area)
            }
        };
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
        match self.rim(found) {
            Ok(rim) => {
                let Lit { surface, area, reach, slope } = self.area(position, normal, &rim, found, scratch);
                let flux = self.sum(&surface, slope, None, &mut scratch.own);
                // Weights by slope may be negative, and so their sum; irradiance is not.
                Some((flux.map(|flux| flux.max(0.0) / (area * self.emitted_paths)), reach))
            }
            Err(Nothing::Dark) => Some(([0.0; 3], 0.0)),
            Err(Nothing::NoArea) => None,
        }
    }

    /// The photon that sets the radius, and the squared radius. Where the limit cuts the search short it sets the radius
    /// itself and all photons count; with no limit, the farthest of the few photons there are does.
    fn rim(&self, found: &Nearest) -> Result<Rim, Nothing> {
        let EstimateOptions { max_dist, estimator, .. } = self.options;
        let (place, radius_squared) = match found.farthest_place() {
            Some((distance, place)) if found.is_full() || max_dist.is_infinite() => (Some(place), distance),
            _ => (None, max_dist * max_dist),
        };
        if radius_squared.is_nan() || radius_squared <= 0.0 {
            return Err(if found.is_empty() { Nothing::Dark } else { Nothing::NoArea });
        }
        Ok(Rim { place: place.filter(|_| estimator == Estimator::Unbiased), radius_squared: f64::from(radius_squared) })
    }

    /// Leaves in `scratch.own` the photons that count, and says what area they light.
    fn area(
        &self,
        position: [f32; 3],
        normal: [f32; 3],
        &Rim { place: rim, radius_squared }: &Rim,
        found: &Nearest,
        scratch: &mut Scratch,
    ) -> Lit {
        let EstimateOptions { kernel, edges, .. } = self.options;
        let surface = Surface { position: Vec3::from(position).as_dvec3(), normal, radius: radius_squared.sqrt() };
        let whole = || Disc::new(Vec3::from(normal).as_dvec3());
        let mut disc = whole();
        self.sort_out(&surface, found, scratch);
        scratch.near_edge = !scratch.around.strangers().is_empty();
        let mut reach = disc.reach();
        let mut integral = kernel.disc();
        let mut with_cut_off = true;
        // An edge that the disc of a limit reaches is as real as one that the k-th photon's does.
        if radius_squared.is_finite() && scratch.near_edge {
            disc.cut(&surface, &mut scratch.around, |around, number| self.stranger(&surface, around, number));
            reach = disc.reach();
            integral = disc.integral(kernel);
            with_cut_off = integral < LEAST_SHARE * kernel.disc();
            // Light behind a wall does not count, whatever the area.
            if with_cut_off || edges == Edges::Ignored {
                (disc, integral) = (whole(), kernel.disc());
            }
        }
        scratch.around.own(with_cut_off, self.placed_rim(rim, found), &mut scratch.own);
        let slope = if edges == Edges::Sloped { Slope::of(&disc, kernel) } else { None };
        Lit { area: radius_squared * integral, reach: reach * surface.radius, surface, slope }
    }

    /// Sorts the photons found into those of the query's surface and strangers.
    fn sort_out(&self, surface: &Surface, found: &Nearest, Scratch { around, kin, .. }: &mut Scratch) {
        around.clear();
        kin.seen_from(surface.normal);
        let known = self.placed.knows(found);
        found.for_photons(|places, distances| {
            let mut is_own = |code| kin.is_same(code, |code| self.placed.normal(code));
            if known {
                around.add(places, distances, |place| self.placed.spot(place), &mut is_own);
            } else {
                let places: Vec<u32> = places.iter().map(|&place| self.placed.place(found.id(place))).collect();
                around.add(&places, distances, |place| self.placed.spot(place), &mut is_own);
            }
        });
    }

    /// The place of the rim's photon here, by its place in the map that found it.
    fn placed_rim(&self, rim: Option<u32>, found: &Nearest) -> Option<u32> {
        let known = self.placed.knows(found);
        rim.map(|rim| if known { rim } else { self.placed.place(found.id(rim)) })
    }

    /// One of the photons around that do not lie on the query's surface.
    fn stranger(&self, surface: &Surface, around: &Around, number: u32) -> Stranger {
        let (place, distance) = (around.places[number as usize], around.distances[number as usize]);
        Stranger {
            rank: (distance, self.placed.id(place)),
            offset: around.offset(surface, number),
            normal: self.placed.direction(place),
        }
    }

    /// Radiance that the photons' flux suggests for a scene of these bounds: the scale for a [`Film`](pm_film::film::Film).
    #[must_use]
    pub fn scale(&self, bounds: &Bounds) -> f64 {
        let mut flux = [0f64; 3];
        for photon in self.photons {
            let power = photon.power();
            (0..3).for_each(|channel| flux[channel] += power[channel] / self.emitted_paths);
        }
        let side = |axis: usize| f64::from(bounds.max[axis]) - f64::from(bounds.min[axis]);
        flux.into_iter().fold(0.0, f64::max) / (0..3).map(|axis| side(axis) * side(axis)).sum::<f64>()
    }
}

/// Where the photons end.
struct Rim {
    /// The place, in the map that found it, of the photon that sets the radius and is not summed.
    place: Option<u32>,
    radius_squared: f64,
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
