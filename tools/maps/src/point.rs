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
        move |a, b| a.key(axis).cmp(&b.key(axis))
    }

    /// One integer that orders by the coordinate and then the id: a comparison of these takes no branch.
    #[inline(always)]
    fn key(&self, axis: usize) -> u64 {
        // Adding 0 makes -0 of them 0. The bits of numbers below 0 order the wrong way round, and behind the others.
        let bits = (self.position[axis] + 0.0).to_bits();
        let ordered = bits ^ (((bits as i32 >> 31) as u32) | 1 << 31);
        u64::from(ordered) << 32 | u64::from(self.id)
    }
}
