//! A split plane with a gap on each side of it, in eight bytes.

/// A gap between two sets of photons, in eight bytes.
#[derive(Clone, Copy, Default)]
pub(super) struct Split {
    /// The largest coordinate on the left, rounded up to a multiple of four units in the last place; the axis in the two
    /// bits that this leaves.
    low_and_axis: u32,
    /// The least coordinate on the right.
    pub(super) high: f32,
}

impl Split {
    pub(super) fn new(axis: usize, low: f32, high: f32) -> Self {
        let bits = low.to_bits();
        // Up is away from zero above it and towards zero below it.
        let up = if low.is_sign_negative() { bits & !3 } else { (bits + 3) & !3 };
        Self { low_and_axis: up | axis as u32, high }
    }

    #[inline(always)]
    pub(super) const fn low(self) -> f32 {
        f32::from_bits(self.low_and_axis & !3)
    }

    #[inline(always)]
    pub(super) const fn axis(self) -> usize {
        (self.low_and_axis & 3) as usize
    }
}
