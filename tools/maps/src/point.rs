//! A photon that is being sorted into a structure.

/// A photon that is being sorted into a structure: where it is, and which it is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Point {
    pub(super) position: [f32; 3],
    pub(super) id: u32,
}

impl Point {
    /// The photons as points.
    pub(super) fn all(photons: &[pm_formats::Photon]) -> Vec<Self> {
        (0..).zip(photons).map(|(id, photon)| Self { position: photon.position, id }).collect()
    }

    /// Order along an axis, ties by id. There are no NaNs among photons that were checked; -0 and 0 are one coordinate.
    pub(super) fn along(axis: usize) -> impl FnMut(&Self, &Self) -> std::cmp::Ordering {
        move |a, b| {
            let coordinates = a.position[axis].partial_cmp(&b.position[axis]);
            coordinates.unwrap_or(std::cmp::Ordering::Equal).then(a.id.cmp(&b.id))
        }
    }
}
