//! The disc over which a photon spreads its flux: that of the photons nearest to the photon itself.

use super::super::disc::Disc;
use super::super::surface::Surface;
use super::{Edges, Kernel, LEAST_SHARE, RadianceEstimate, Scratch};
use glam::{DVec3, Vec3};
use pm_formats::Photon;
use pm_maps::Nearest;

/// What a photon lights.
pub(crate) struct Spread {
    /// Of the ball of the k photons nearest to it, in scene units.
    pub(crate) radius: f64,
    /// Its flux per area: what it adds to the irradiance in its middle, in watts per square scene unit.
    pub(crate) density: [f64; 3],
    /// Planes beyond which it lights nothing: unit normal towards the photon, and the photon's distance in radii.
    pub(crate) planes: Vec<(DVec3, f64)>,
}

impl RadianceEstimate<'_> {
    /// How much a photon counts by its distance.
    pub(crate) const fn kernel(&self) -> Kernel {
        self.options.kernel
    }

    /// The disc of a photon whose nearest these are, with this many cuts at most; `None` if it has no area.
    pub(crate) fn spread(
        &self,
        photon: &Photon,
        found: &Nearest,
        most_cuts: usize,
        scratch: &mut Scratch,
    ) -> Option<Spread> {
        let kernel = self.options.kernel;
        let radius_squared = self.rim(found).ok()?.radius_squared;
        let normal = photon.normal();
        let position = Vec3::from(photon.position).as_dvec3();
        let surface = Surface { position, normal, radius: radius_squared.sqrt() };
        self.sort_out(&surface, found, scratch);
        let whole = || Disc::new(Vec3::from(normal).as_dvec3());
        let mut disc = whole();
        disc.cut_up_to(most_cuts, &surface, &mut scratch.around, |around, number| {
            self.stranger(&surface, around, number)
        });
        // As where a query has the disc.
        if disc.integral(kernel) < LEAST_SHARE * kernel.disc() {
            disc = whole();
        }
        let lit = if self.options.edges == Edges::Ignored { kernel.disc() } else { disc.integral(kernel) };
        let density = photon.power().map(|flux| flux / (radius_squared * lit * self.emitted_paths));
        Some(Spread { radius: surface.radius, density, planes: disc.planes().collect() })
    }
}
