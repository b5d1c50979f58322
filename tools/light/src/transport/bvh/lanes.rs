//! Eight numbers side by side. The one place of this crate that says `unsafe`.
//!
//! A search is written once, over lanes: plain arrays, or vectors where the machine has AVX2. The same operations in the same
//! order, so that both find the same to the bit.
#![expect(unsafe_code, reason = "functions for instructions that not every machine has, called where they are there")]

/// Numbers side by side.
pub(super) const LANES: usize = 8;

/// As arithmetic on single numbers, in every lane.
pub(super) trait Lanes: Copy {
    fn load(from: &[f32; LANES]) -> Self;
    fn splat(number: f32) -> Self;
    fn store(self) -> [f32; LANES];
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    fn over(self, other: Self) -> Self;
    /// The smaller; the other's where one is not a number.
    fn min(self, other: Self) -> Self;
    /// The larger; the other's where one is not a number.
    fn max(self, other: Self) -> Self;
    /// A bit for every lane that is at most the other's.
    fn at_most(self, other: Self) -> u32;
}

/// What can be done by any lanes.
pub(super) trait Work {
    /// What it finds.
    type Found;

    fn run<L: Lanes>(self) -> Self::Found;
}

/// Kinds of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Instructions {
    /// What every machine has.
    Plain,
    /// AVX2.
    Avx2,
}

impl Instructions {
    /// All of them, plain ones first.
    #[cfg(test)]
    pub(super) const ALL: [Self; 2] = [Self::Plain, Self::Avx2];

    /// The best that this machine has.
    pub(super) fn best() -> Self {
        if Self::Avx2.are_there() { Self::Avx2 } else { Self::Plain }
    }

    /// Whether this machine has them.
    #[inline(always)]
    pub(super) fn are_there(self) -> bool {
        match self {
            Self::Plain => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("bmi1"),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 => false,
        }
    }

    /// Does some work by these instructions, or by plain ones where they are not there.
    #[inline(always)]
    pub(super) fn run<W: Work>(self, work: W) -> W::Found {
        match self {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: they are there.
            Self::Avx2 if self.are_there() => unsafe { x86::run(work) },
            _ => work.run::<[f32; LANES]>(),
        }
    }
}

#[inline(always)]
fn each(a: [f32; LANES], b: [f32; LANES], operation: impl Fn(f32, f32) -> f32) -> [f32; LANES] {
    std::array::from_fn(|lane| operation(a[lane], b[lane]))
}

impl Lanes for [f32; LANES] {
    #[inline(always)]
    fn load(from: &[f32; LANES]) -> Self {
        *from
    }

    #[inline(always)]
    fn splat(number: f32) -> Self {
        [number; LANES]
    }

    #[inline(always)]
    fn store(self) -> [f32; LANES] {
        self
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        each(self, other, |a, b| a + b)
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        each(self, other, |a, b| a - b)
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        each(self, other, |a, b| a * b)
    }

    #[inline(always)]
    fn over(self, other: Self) -> Self {
        each(self, other, |a, b| a / b)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        each(self, other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        each(self, other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> u32 {
        (0..LANES).fold(0, |mask, lane| mask | u32::from(self[lane] <= other[lane]) << lane)
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use crate::transport::bvh::lanes::{LANES, Lanes, Work};
    use std::arch::x86_64::*;

    #[target_feature(enable = "avx2,bmi1")]
    pub(super) fn run<W: Work>(work: W) -> W::Found {
        work.run::<Avx2>()
    }

    /// Known only to `run`, where AVX2 is there: that is what makes the functions below safe.
    #[derive(Clone, Copy)]
    struct Avx2(__m256);

    impl Lanes for Avx2 {
        #[inline(always)]
        fn load(from: &[f32; LANES]) -> Self {
            // SAFETY: eight numbers are there to be read.
            Self(unsafe { _mm256_loadu_ps(from.as_ptr()) })
        }

        #[inline(always)]
        fn splat(number: f32) -> Self {
            // SAFETY: AVX2 is there, here as below.
            Self(unsafe { _mm256_set1_ps(number) })
        }

        #[inline(always)]
        fn store(self) -> [f32; LANES] {
            let mut to = [0.0; LANES];
            // SAFETY: there is room for eight numbers.
            unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) };
            to
        }

        #[inline(always)]
        fn plus(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_add_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn minus(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_sub_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn times(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_mul_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn over(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_div_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn min(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_min_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn max(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_max_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn at_most(self, other: Self) -> u32 {
            // SAFETY: see above.
            unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, other.0)) }.cast_unsigned()
        }
    }
}
