//! Whether light is focused by mirrors and glass in a scene, and how many photons of it are worth the paths they take.

use pm_light::scene::{MaterialKind, Scene};
use pm_light::transport::PhotonPaths;

/// Paths that are traced to see how many of them store photons of caustics.
const PROBE: u64 = 1 << 16;
/// Paths that a map of caustics is worth at most.
const MOST_PATHS: u64 = 1 << 24;

/// How many photons a map of caustics shall have: as many as are wanted, or as [`MOST_PATHS`] store; none where no light comes
/// to a surface by mirrors and glass alone, or next to none.
pub(crate) fn photons(scene: &Scene, wanted: u64, seed: u64) -> u64 {
    let sparkles = |kind| matches!(kind, MaterialKind::Mirror | MaterialKind::Glass);
    if wanted == 0 || !scene.materials.iter().any(|material| sparkles(material.kind)) {
        return 0;
    }
    let paths = PhotonPaths::of_caustics(scene, seed);
    let mut found = 0;
    for path in 0..PROBE {
        paths.trace(path, |photon| found += u64::from(photon.power.max_element() > 0.0));
    }
    wanted.min(found * (MOST_PATHS / PROBE))
}
