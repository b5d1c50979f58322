//! Which instructions numbers are packed by. The one place of this crate that says `unsafe`.
//!
//! One by one a number costs nine instructions, eight at a time two: packing was a quarter of a run of one LRU cache over a trace in
//! Hilbert order (`make bench-traces` shows what is left). Compilers find no vector code for it, since where a number goes depends
//! on those before.
#![expect(unsafe_code, reason = "a function for instructions that not every machine has, called where they are there")]

use super::pack_changes_one_by_one;

/// Kinds of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Instructions {
    /// What every machine has.
    Plain,
    /// AVX2, eight lanes.
    Avx2,
}

impl Instructions {
    /// All of them, plain ones first.
    #[cfg(test)]
    pub(super) const ALL: [Self; 2] = [Self::Plain, Self::Avx2];

    /// The best that this machine has.
    #[inline]
    pub(super) fn best() -> Self {
        if Self::Avx2.are_there() { Self::Avx2 } else { Self::Plain }
    }

    /// Whether this machine has them.
    #[inline]
    pub(super) fn are_there(self) -> bool {
        match self {
            Self::Plain => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("popcnt"),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 => false,
        }
    }

    /// As [`pack_changes`](super::pack_changes), by these, which are there.
    pub(super) fn pack_changes(self, numbers: &[u32], before: u32, to: &mut [u32]) -> usize {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => {
                assert!(self.are_there());
                // SAFETY: they are.
                unsafe { x86::pack_changes(numbers, before, to) }
            }
            _ => pack_changes_one_by_one(numbers, before, to),
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::super::{SLACK, pack_changes_one_by_one};
    use std::arch::x86_64::*;

    /// Numbers in a vector.
    const LANES: usize = 8;

    /// By the bits of the lanes that are kept: their indices in ascending order, a byte each. Behind them stands anything.
    const KEPT: [u64; 1 << LANES] = {
        let mut kept = [0; 1 << LANES];
        let mut mask = 0;
        while mask < kept.len() {
            let (mut lane, mut to) = (0, 0);
            while lane < LANES {
                if mask >> lane & 1 == 1 {
                    kept[mask] |= (lane as u64) << (8 * to);
                    to += 1;
                }
                lane += 1;
            }
            mask += 1;
        }
        kept
    };

    #[target_feature(enable = "avx2,popcnt")]
    pub(super) fn pack_changes(numbers: &[u32], before: u32, to: &mut [u32]) -> usize {
        let to = &mut to[..numbers.len() + SLACK];
        // The first has nothing beside it, and then as many as vectors hold.
        let Some((first, others)) = numbers.split_first() else { return 0 };
        to[0] = *first;
        let mut len = usize::from(*first != before);
        let vectors = others.len() / LANES;
        for vector in 0..vectors {
            let at = LANES * vector;
            // SAFETY: numbers[at..at + 9] exist, since others[at..at + 8] do; `len` is at most the `at + 1` numbers before, and `to`
            // has room for eight more than all.
            unsafe {
                let these = _mm256_loadu_si256(numbers.as_ptr().add(at + 1).cast());
                let before = _mm256_loadu_si256(numbers.as_ptr().add(at).cast());
                let same = _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(these, before)));
                let kept = !same as usize & ((1 << LANES) - 1);
                let lanes = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(KEPT[kept].cast_signed()));
                _mm256_storeu_si256(to.as_mut_ptr().add(len).cast(), _mm256_permutevar8x32_epi32(these, lanes));
                len += kept.count_ones() as usize;
            }
        }
        let done = 1 + LANES * vectors;
        len + pack_changes_one_by_one(&numbers[done..], numbers[done - 1], &mut to[len..])
    }
}
