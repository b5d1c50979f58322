//! Gather rays from a point whose irradiance is cached, one through each stratum, whoever sees it.

use super::direct::Techniques;
use super::gather_path::{End, PathRandom};
use super::gather_rays::GatherRays;
use super::purpose::Purpose;
use super::ray_counts::RayCounts;
use super::sampling::cosine_direction;
use super::surface::SurfacePoint;
use glam::Vec3;
use pm_random::Random;

/// Sets the keys of records apart from those of pixels.
const RECORDS: u64 = 1 << 32;

/// The rays of one record.
pub(super) struct RecordRays<'r> {
    pub(super) rays: &'r GatherRays<'r>,
    pub(super) point: &'r SurfacePoint,
    /// Number of the record.
    pub(super) id: u32,
}

impl RecordRays<'_> {
    /// Length of a ray to the first surface; infinite if it meets none.
    pub(super) fn length(&self, stratum: u32) -> f32 {
        let (direction, _) = self.direction(stratum);
        let hit = self.rays.paths.surfaces.hit(self.point.start(direction), direction);
        hit.map_or(f32::INFINITY, |hit| hit.position.distance(self.point.position))
    }

    /// Casts a ray; its weight is 1, changed only by what it meets on the way.
    pub(super) fn cast(&self, stratum: u32, light: &mut impl FnMut(Vec3), counts: &mut RayCounts) -> Option<End> {
        let (direction, path) = self.direction(stratum);
        let id = RECORDS | u64::from(self.id);
        let key = [self.rays.options.seed, Purpose::LightAtShortEnd as u64, id, stratum.into()];
        let mut random = PathRandom { path, light_at_short_end: || Random::new(&key) };
        // Its irradiance is that from surfaces alone: each point seen adds its own light from the lamps.
        let techniques = Techniques { shadow: 0, gather: 0 };
        self.rays.paths.cast(self.point, (direction, techniques), Vec3::ONE, &mut random, light, counts)
    }

    /// The direction of a ray within its stratum, and the random numbers for what follows.
    fn direction(&self, stratum: u32) -> (Vec3, Random) {
        let key = [self.rays.options.seed, Purpose::RecordRay as u64, self.id.into(), stratum.into()];
        let mut random = Random::new(&key);
        let (u, v) = self.rays.strata.point(stratum, &mut random);
        (cosine_direction(self.point.facing, u, v), random)
    }
}
