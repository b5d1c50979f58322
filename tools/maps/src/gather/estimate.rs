//! The radiance estimate: flux of the nearest photons per area of the disc that holds them.
//!
//! Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 7.2.

use super::disc::{Disc, Stranger};
use super::kernel::Kernel;
use crate::Nearest;
use glam::{DVec3, Vec3};
use pm_formats::{Bounds, Material, Photon, Query};
use std::f64::consts::PI;

pm_registry::choices! {
    /// How the photons found become a radiance.
    #[derive(Debug)]
    pub enum Estimator {
        /// The k-th photon sets the radius and is not summed: unbiased where photons are spread evenly
        Unbiased = "unbiased",
        /// All k photons are summed, as in the textbook: k/(k-1) too bright for ever
        Classic = "classic",
    }
}

pm_registry::choices! {
    /// Which area the flux is divided by.
    #[derive(Debug)]
    pub enum Edges {
        /// The part of the photons' disc on this side of the edges that photons round the corner show
        Cut = "cut",
        /// The whole disc, as in the textbook: dark at edges
        Ignored = "ignored",
    }
}

/// What searches were made, and how photons become a radiance.
#[derive(Clone, Copy, Debug)]
pub struct EstimateOptions {
    /// Photons searched for.
    pub k: usize,
    /// Largest distance at which a photon counts, in scene units.
    pub max_dist: f32,
    /// Which photons are summed.
    pub estimator: Estimator,
    /// How much each counts by its distance.
    pub kernel: Kernel,
    /// Which area the sum is divided by.
    pub edges: Edges,
}

/// What became of a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// Radiance towards the viewer, linear RGB, times the query's weight.
    Radiance([f64; 3]),
    /// The nearest photons all lie at the query's own point, so that their disc has no area: nothing can be said.
    NoArea,
    /// Irradiance was computed beforehand nowhere where the normal is similar: no light.
    NoSite,
}

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

/// Photons whose surface is turned farther than this from the query's are left out of the sum: they lie round a corner
/// or on the other side. The cosine of 26 degrees: well beyond the 2 degrees that the packed normal may be off.
const MIN_NORMAL_COSINE: f32 = 0.9;

/// Cuts that leave less than this share of the disc are not made: next to no photon lies there, and where surfaces are a
/// tangle nothing may be left to divide by.
const LEAST_SHARE: f64 = 1.0 / 64.0;

/// A unit normal in steps of 1/127.
#[expect(clippy::cast_possible_truncation, reason = "|components| <= 1")]
pub(super) fn coarse(normal: [f32; 3]) -> [i8; 3] {
    normal.map(|x| (x * 127.0).round() as i8)
}

/// Is a photon's surface, by its coarse normal, the one whose unit normal is `normal`?
#[inline]
pub(super) fn on_same_surface(photon: [i8; 3], normal: [f32; 3]) -> bool {
    let [x, y, z] = photon.map(f32::from);
    x * normal[0] + y * normal[1] + z * normal[2] > MIN_NORMAL_COSINE * 127.0
}

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
        let (surface, area) = match self.area(query.position, query.normal(), found, scratch) {
            Ok(known) => known,
            Err(Nothing::Dark) => return Outcome::Radiance([0.0; 3]),
            Err(Nothing::NoArea) => return Outcome::NoArea,
        };
        let material = &self.materials[usize::from(query.material)];
        let reflected = self.reflected(&surface, query, material, &mut scratch.own);
        Outcome::Radiance(
            [0, 1, 2]
                .map(|channel| f64::from(query.weight[channel]) * reflected[channel] / (area * self.emitted_paths)),
        )
    }

    /// Irradiance at a point of a surface, in watts per square scene unit, given the photons found for it; `None` if
    /// their disc has no area.
    #[must_use]
    pub fn irradiance(
        &self,
        position: [f32; 3],
        normal: [f32; 3],
        found: &Nearest,
        scratch: &mut Scratch,
    ) -> Option<[f64; 3]> {
        match self.area(position, normal, found, scratch) {
            Ok((surface, area)) => {
                let flux = self.sum(&surface, None, &mut scratch.own);
                Some(flux.map(|flux| flux / (area * self.emitted_paths)))
            }
            Err(Nothing::Dark) => Some([0.0; 3]),
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
    ) -> Result<(Surface, f64), Nothing> {
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
        let mut disc = Disc::new(Vec3::from(normal).as_dvec3());
        self.sort_out(&surface, found, rim, scratch);
        // An edge that the disc of a limit reaches is as real as one that the k-th photon's does.
        if edges == Edges::Cut && radius_squared.is_finite() && !scratch.strangers.is_empty() {
            disc.cut(&scratch.strangers);
            if disc.integral(kernel) < LEAST_SHARE * kernel.disc() {
                disc = Disc::new(Vec3::from(normal).as_dvec3());
            }
            if !disc.is_whole() {
                scratch.own.retain(|&(id, _)| disc.holds(surface.offset(&self.photons[id as usize])));
            }
        }
        Ok((surface, radius_squared * disc.integral(kernel)))
    }

    /// Sorts the photons found into those of the query's surface and strangers; `rim` is not among the former.
    fn sort_out(&self, surface: &Surface, found: &Nearest, rim: Option<u32>, scratch: &mut Scratch) {
        let wanted = self.options.edges == Edges::Cut;
        scratch.own.clear();
        scratch.strangers.clear();
        for (distance, id) in found.iter() {
            if on_same_surface(self.flux[id as usize].normal, surface.normal) {
                if Some(id) != rim {
                    scratch.own.push((id, distance));
                }
            } else if wanted {
                let photon = &self.photons[id as usize];
                let normal = Vec3::from(photon.normal()).as_dvec3();
                scratch.strangers.push(Stranger { rank: (distance, id), offset: surface.offset(photon), normal });
            }
        }
    }

    /// Sum over photons of kernel weight x BRDF x power.
    fn reflected(&self, surface: &Surface, query: &Query, material: &Material, own: &mut [(u32, f32)]) -> [f64; 3] {
        let diffuse = material.diffuse.map(|share| f64::from(share) / PI);
        match Lobe::of(material, query) {
            // Where every photon counts alike the BRDF waits until the powers are summed, exactly.
            None => {
                let sum = self.sum(surface, None, own);
                [0, 1, 2].map(|channel| sum[channel] * diffuse[channel])
            }
            Some(lobe) => self.sum(surface, Some((&lobe, diffuse)), own),
        }
    }

    /// Sum over photons of kernel weight x power, times the BRDF (lobe and diffuse part) if there is one.
    fn sum(&self, surface: &Surface, brdf: Option<(&Lobe, [f64; 3])>, own: &mut [(u32, f32)]) -> [f64; 3] {
        let kernel = self.options.kernel;
        let exact = self.exact_sums && kernel == Kernel::Constant && brdf.is_none();
        if !exact {
            // Rounded sums depend on their order: then it is that of the ids, whatever order they were found in.
            own.sort_unstable_by_key(|&(id, _)| id);
        }
        let mut sum = [0f64; 3];
        for &(id, distance) in &*own {
            let power = self.flux[id as usize].power;
            let weight = match kernel {
                Kernel::Constant => 1.0,
                _ => kernel.weight(f64::from(distance).sqrt() / surface.radius),
            };
            match brdf {
                None => (0..3).for_each(|channel| sum[channel] += weight * f64::from(power[channel])),
                Some((lobe, diffuse)) => {
                    let glossy = lobe.brdf(self.photons[id as usize].towards_source());
                    for channel in 0..3 {
                        sum[channel] += weight * f64::from(power[channel]) * (diffuse[channel] + glossy[channel]);
                    }
                }
            }
        }
        sum
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

/// Why there is no area that photons light.
enum Nothing {
    /// None was found.
    Dark,
    /// All were found at one point.
    NoArea,
}

/// Where light is asked for.
struct Surface {
    position: DVec3,
    normal: [f32; 3],
    radius: f64,
}

impl Surface {
    /// Where a photon is, from there, in radii.
    fn offset(&self, photon: &Photon) -> DVec3 {
        (Vec3::from(photon.position).as_dvec3() - self.position) / self.radius
    }
}

/// The glossy part of a BRDF: Phong's lobe about the mirrored direction of view, over the larger of the two cosines so
/// that little is lost at grazing angles: Neumann, Neumann, Szirmay-Kalos, *Compact Metallic Reflectance Models*,
/// Eurographics 1999. It is the BRDF that photons and gather rays were scattered by.
struct Lobe {
    /// Specular reflectance times (n + 2) / (2 pi), per steradian.
    peak: [f64; 3],
    exponent: f64,
    mirrored_view: DVec3,
    normal: DVec3,
    view_cosine: f64,
}

/// Directions are packed: one along the surface may seem to come from below.
const LEAST_COSINE: f64 = 1e-4;

impl Lobe {
    fn of(material: &Material, query: &Query) -> Option<Self> {
        if material.specular.iter().all(|&share| share <= 0.0) {
            return None;
        }
        let exponent = f64::from(material.exponent);
        let (normal, view) = (Vec3::from(query.normal()).as_dvec3(), Vec3::from(query.view()).as_dvec3());
        Some(Self {
            peak: material.specular.map(|share| f64::from(share) * (exponent + 2.0) / (2.0 * PI)),
            exponent,
            mirrored_view: normal * (2.0 * normal.dot(view)) - view,
            normal,
            view_cosine: normal.dot(view),
        })
    }

    fn brdf(&self, towards_source: [f32; 3]) -> [f64; 3] {
        let source = Vec3::from(towards_source).as_dvec3();
        let larger = self.view_cosine.max(self.normal.dot(source)).max(LEAST_COSINE);
        let lobe = libm::pow(self.mirrored_view.dot(source).clamp(0.0, 1.0), self.exponent) / larger;
        self.peak.map(|peak| peak * lobe)
    }
}
