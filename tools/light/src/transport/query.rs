//! A gather query, as the stream carries it.

use super::surface::SurfacePoint;
use glam::Vec3;
use pm_formats::Query;

/// A query for the radiance that a point sends along `view`.
pub(super) fn query_at(point: &SurfacePoint, view: Vec3, pixel: u32, sample: u32, weight: Vec3) -> Query {
    let (normal, view) = Query::pack_vectors(point.facing.into(), view.into());
    Query {
        position: point.position.into(),
        normal,
        view,
        material: point.material,
        flags: 0,
        pixel,
        sample,
        weight: weight.into(),
    }
}
