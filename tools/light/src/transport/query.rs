//! A gather query, as the stream carries it.

use super::surface::SurfacePoint;
use glam::Vec3;
use pm_formats::Query;

/// A query for the radiance that a point sends along `view`.
#[inline]
pub(super) fn query_at(point: &SurfacePoint, view: Vec3, pixel: u32, sample: u32, weight: Vec3) -> Query {
    Query {
        position: point.position.into(),
        normal: point.packed_facing,
        view: Query::pack_vector(view.into()),
        material: point.material,
        flags: 0,
        pixel,
        sample,
        weight: weight.into(),
    }
}
