//! A gather query, as the stream carries it.

use super::surface::{Met, SurfacePoint};
use glam::Vec3;
use pm_formats::Query;

/// A query for the radiance that a point sends along `view`.
pub(super) fn query_at(point: &SurfacePoint, view: Vec3, pixel: u32, sample: u32, weight: Vec3) -> Query {
    let &SurfacePoint { position, packed_facing, material, .. } = point;
    Met { position, packed_facing, material }.query(view, pixel, sample, weight)
}

impl Met {
    /// The same of a point of which no more is known.
    #[inline]
    pub(super) fn query(&self, view: Vec3, pixel: u32, sample: u32, weight: Vec3) -> Query {
        Query {
            position: self.position.into(),
            normal: self.packed_facing,
            view: Query::pack_vector(view.into()),
            material: self.material,
            flags: 0,
            pixel,
            sample,
            weight: weight.into(),
        }
    }
}
