//! How light goes through a scene: photons from the lights, and the queries that ask for them.
//!
//! Every random number is a function of (seed, path) or (seed, pixel, sample): which rays are cast does not depend on the
//! order of work. Transcendental functions come from `libm`, so recorded results are the same bytes on every x86-64.
//!
//! A module knows only modules above it:
//!
//! | modules | are about |
//! | --- | --- |
//! | `purpose`, `roulette`, `sampling` | random numbers, and what is made of them |
//! | `bvh`, `surface` | where rays hit |
//! | `scatter`, `directions`, `reflection`, `lights`, `direct` | what surfaces and lamps do |
//! | `aim`, `photon_paths` | photons |
//! | `eye`, `guide`, `strata` | which points are seen, and in which directions rays go from there |
//! | `gather_options`, `ray_counts`, `gather_path`, `query`, `gather_rays` | gather rays, and the queries where they end |
//! | `record_rays`, `cache_records` | cached irradiance |
//! | `pixel_caster`, `ray_plan` | all of it pixel by pixel, in the order of a stream |

mod aim;
mod bvh;
mod cache_records;
mod direct;
mod directions;
mod eye;
mod gather_options;
mod gather_path;
mod gather_rays;
mod guide;
mod lights;
mod photon_paths;
mod pixel_caster;
mod purpose;
mod query;
mod ray_counts;
mod ray_plan;
mod record_rays;
mod reflection;
mod roulette;
mod sampling;
mod scatter;
mod strata;
mod surface;
mod turn;

pub use bvh::{Bvh, RayCaster, RayHit};
pub use cache_records::{CacheOptions, CacheRecords};
pub use gather_options::{AtSpecular, GatherOptions, Method};
pub use gather_rays::GatherRays;
pub use photon_paths::{PathPhoton, PhotonPaths, photon_rounding};
pub use pixel_caster::PixelCaster;
pub use ray_counts::RayCounts;
pub use ray_plan::{Piece, RayPlan};
pub use reflection::Spread;
pub use strata::Strata;
pub use surface::{SurfacePoint, Surfaces};

#[cfg(test)]
mod tests;
