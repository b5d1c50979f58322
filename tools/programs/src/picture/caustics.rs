//! Whether light is focused by mirrors and glass in a scene, and how many photons of it are worth the paths they take.

use pm_light::scene::MaterialKind;
use pm_light::transport::{PhotonPaths, Surfaces};

/// Paths that are traced to see how many of them store photons of caustics.
const PROBE: u64 = 1 << 16;
/// Paths that a map of caustics is worth at most.
const MOST_PATHS: u64 = 1 << 24;

/// How many photons a map of caustics shall have, and their paths: as many as are wanted, or as [`MOST_PATHS`] store; none where
/// no light comes to a surface by mirrors and glass alone, or next to none.
pub(crate) fn found<'a>(surfaces: &Surfaces<'a>, wanted: u64, seed: u64) -> Option<(u64, PhotonPaths<'a>)> {
    let sparkles = |kind| matches!(kind, MaterialKind::Mirror | MaterialKind::Glass);
    if wanted == 0 || !surfaces.scene.materials.iter().any(|material| sparkles(material.kind)) {
        return None;
    }
    let paths = PhotonPaths::of_caustics(surfaces.clone(), seed);
    let mut found = 0;
    for path in 0..PROBE {
        paths.trace(path, |photon| found += u64::from(photon.power.max_element() > 0.0));
    }
    let photons = wanted.min(found * (MOST_PATHS / PROBE));
    (photons > 0).then_some((photons, paths))
}
