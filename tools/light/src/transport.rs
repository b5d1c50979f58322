//! How light goes through a scene: photons from the lights, and the queries that ask for them.
//!
//! Every random number is a function of (seed, path) or (seed, pixel, sample): which rays are cast does not depend on the
//! order of work. Transcendental functions come from `libm`, so recorded results are the same bytes on every x86-64.

mod bvh;
mod cache_records;
mod eye;
mod gather_rays;
mod guide;
mod lights;
mod photon_paths;
mod ray_plan;
mod reflection;
mod sampling;
mod scatter;
mod surface;

pub use bvh::{Bvh, RayCaster, RayHit};
pub use cache_records::{CacheOptions, CacheRecords};
pub use gather_rays::{GatherOptions, GatherRays, Method, RayCounts, Strata, Visits};
pub use photon_paths::{PathPhoton, PhotonPaths};
pub use ray_plan::{Piece, RayPlan};
pub use reflection::Spread;
pub use surface::{Stage, SurfacePoint};

#[cfg(test)]
mod tests;

/// What random numbers are for: keys of different purposes never meet.
#[derive(Clone, Copy)]
#[repr(u64)]
enum Purpose {
    PhotonPath = 1,
    PhotonRounding = 2,
    EyePath = 3,
    GatherRay = 4,
    DirectLight = 5,
    StrataOrder = 6,
    LightAtShortEnd = 7,
    PixelSample = 8,
    RecordRay = 9,
}
