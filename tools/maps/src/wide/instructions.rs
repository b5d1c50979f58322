//! Which instructions a search is made of. The one place of this crate that says `unsafe`.
//!
//! The search is written once, in plain loops over sixteen lanes that compilers turn into vector code for whatever
//! instructions the function around them may use. Two things are beyond them and are said in intrinsics: the mask of a
//! comparison, and packing the lanes of a mask. `cargo bench -p pm-programs --bench maps` compares the times.
#![expect(unsafe_code, reason = "functions for instructions that not every machine has, called where they are there")]

use super::WIDTH;
use super::kernels::{Kernels, Plain, Work};

/// Kinds of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// What every machine has.
    Plain,
    /// AVX2, eight lanes.
    Avx2,
    /// AVX-512, sixteen lanes.
    Avx512,
}

impl Instructions {
    /// All of them, plain ones first.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Avx2, Self::Avx512];

    /// The best that this machine has.
    #[must_use]
    pub fn best() -> Self {
        Self::ALL.into_iter().rfind(|instructions| instructions.are_there()).unwrap_or(Self::Plain)
    }

    /// Whether this machine has them.
    #[must_use]
    pub fn are_there(self) -> bool {
        match self {
            Self::Plain => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("bmi2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                Self::Avx2.are_there()
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("avx512dq")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// Does some work by these instructions.
    #[inline]
    pub(super) fn run<W: Work>(self, work: W) -> W::Found {
        match self {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: a tree has only instructions that are there: `best` and `WideTree::with` see to it.
            Self::Avx512 => unsafe { x86::avx512(work) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: as above.
            Self::Avx2 => unsafe { x86::avx2(work) },
            #[cfg(target_arch = "x86_64")]
            Self::Plain => work.run::<x86::Sse>(),
            #[cfg(not(target_arch = "x86_64"))]
            _ => work.run::<Plain>(),
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::*;
    use std::arch::x86_64::*;

    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512bw,avx512dq")]
    pub(super) fn avx512<W: Work>(work: W) -> W::Found {
        work.run::<Avx512>()
    }

    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
    pub(super) fn avx2<W: Work>(work: W) -> W::Found {
        work.run::<Avx2>()
    }

    /// Plain loops but for the mask, of which compilers make sixteen comparisons.
    pub(super) struct Sse;

    impl Kernels for Sse {
        #[inline(always)]
        fn within(distances: &[f32; WIDTH], bound: f32) -> u32 {
            let mut mask = 0;
            for quarter in 0..4 {
                // SAFETY: every x86-64 has SSE; the four quarters make up the array.
                let four = unsafe {
                    let these = _mm_loadu_ps(distances.as_ptr().add(4 * quarter));
                    _mm_movemask_ps(_mm_cmple_ps(these, _mm_set1_ps(bound)))
                };
                mask |= (four as u32) << (4 * quarter);
            }
            mask
        }

        #[inline(always)]
        fn append_to(
            to: (&mut [f32], &mut [u32]),
            at: usize,
            distances: &[f32; WIDTH],
            places: &[u32; WIDTH],
            mask: u32,
        ) {
            Plain::append_to(to, at, distances, places, mask);
        }

        #[inline(always)]
        fn append_leaf(to: (&mut [f32], &mut [u32]), at: usize, distances: &[f32; WIDTH], first: u32, mask: u32) {
            Plain::append_leaf(to, at, distances, first, mask);
        }

        #[inline(always)]
        fn pack(to: &mut [f32], at: usize, lanes: &[f32; WIDTH], mask: u32) {
            Plain::pack(to, at, lanes, mask);
        }

        #[inline(always)]
        fn append_numbers(to: &mut [u32], len: &mut usize, first: u32, mask: u32) {
            Plain::append_numbers(to, len, first, mask);
        }

        #[inline(always)]
        fn count(distances: &[[f32; WIDTH]], bound: f32) -> usize {
            Plain::count(distances, bound)
        }
    }

    /// The numbers of lanes.
    static LANES: [u32; WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

    /// Sixteen lanes.
    struct Avx512;

    impl Kernels for Avx512 {
        #[inline(always)]
        fn within(distances: &[f32; WIDTH], bound: f32) -> u32 {
            // SAFETY: only `avx512` searches by these kernels.
            unsafe {
                let distances = _mm512_loadu_ps(distances.as_ptr());
                u32::from(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(distances, _mm512_set1_ps(bound)))
            }
        }

        #[inline(always)]
        fn append_to(
            (to_distances, to_places): (&mut [f32], &mut [u32]),
            at: usize,
            distances: &[f32; WIDTH],
            places: &[u32; WIDTH],
            mask: u32,
        ) {
            let (to_distances, to_places) = (&mut to_distances[at..][..WIDTH], &mut to_places[at..][..WIDTH]);
            // SAFETY: only `avx512` searches by these kernels; each slice has sixteen elements.
            unsafe {
                let packed = _mm512_maskz_compress_ps(mask as u16, _mm512_loadu_ps(distances.as_ptr()));
                _mm512_storeu_ps(to_distances.as_mut_ptr(), packed);
                let packed = _mm512_maskz_compress_epi32(mask as u16, _mm512_loadu_si512(places.as_ptr().cast()));
                _mm512_storeu_si512(to_places.as_mut_ptr().cast(), packed);
            }
        }

        #[inline(always)]
        fn append_leaf(to: (&mut [f32], &mut [u32]), at: usize, distances: &[f32; WIDTH], first: u32, mask: u32) {
            let (to_distances, to_places) = (&mut to.0[at..][..WIDTH], &mut to.1[at..][..WIDTH]);
            // SAFETY: only `avx512` searches by these kernels; each slice has sixteen elements.
            unsafe {
                let packed = _mm512_maskz_compress_ps(mask as u16, _mm512_loadu_ps(distances.as_ptr()));
                _mm512_storeu_ps(to_distances.as_mut_ptr(), packed);
                let lanes = _mm512_loadu_si512(LANES.as_ptr().cast());
                let places = _mm512_add_epi32(lanes, _mm512_set1_epi32(first as i32));
                let packed = _mm512_maskz_compress_epi32(mask as u16, places);
                _mm512_storeu_si512(to_places.as_mut_ptr().cast(), packed);
            }
        }

        #[inline(always)]
        fn pack(to: &mut [f32], at: usize, lanes: &[f32; WIDTH], mask: u32) {
            let to = &mut to[at..][..WIDTH];
            // SAFETY: only `avx512` and its like search by these kernels; the slice has sixteen elements.
            unsafe {
                let packed = _mm512_maskz_compress_ps(mask as u16, _mm512_loadu_ps(lanes.as_ptr()));
                _mm512_storeu_ps(to.as_mut_ptr(), packed);
            }
        }

        #[inline(always)]
        fn append_numbers(to: &mut [u32], len: &mut usize, first: u32, mask: u32) {
            let room = &mut to[*len..][..WIDTH];
            // SAFETY: only `avx512` searches by these kernels; the slice has sixteen elements.
            unsafe {
                let lanes = _mm512_loadu_si512(LANES.as_ptr().cast());
                let numbers = _mm512_add_epi32(lanes, _mm512_set1_epi32(first as i32));
                _mm512_storeu_si512(room.as_mut_ptr().cast(), _mm512_maskz_compress_epi32(mask as u16, numbers));
            }
            *len += mask.count_ones() as usize;
        }
    }

    /// Twice eight lanes.
    struct Avx2;

    /// Which lanes a mask of eight packs to the front.
    static PACK: [[u32; 8]; 256] = {
        let mut table = [[0; 8]; 256];
        let mut mask = 0;
        while mask < 256 {
            let (mut lane, mut number) = (0, 0);
            while lane < 8 {
                if mask >> lane & 1 == 1 {
                    table[mask][number] = lane;
                    number += 1;
                }
                lane += 1;
            }
            mask += 1;
        }
        table
    };

    impl Kernels for Avx2 {
        #[inline(always)]
        fn within(distances: &[f32; WIDTH], bound: f32) -> u32 {
            // SAFETY: only `avx2` searches by these kernels; both halves lie within the array.
            unsafe {
                let bound = _mm256_set1_ps(bound);
                let first = _mm256_cmp_ps::<_CMP_LE_OQ>(_mm256_loadu_ps(distances.as_ptr()), bound);
                let second = _mm256_cmp_ps::<_CMP_LE_OQ>(_mm256_loadu_ps(distances.as_ptr().add(8)), bound);
                _mm256_movemask_ps(first) as u32 | (_mm256_movemask_ps(second) as u32) << 8
            }
        }

        #[inline(always)]
        fn append_to(
            (to_distances, to_places): (&mut [f32], &mut [u32]),
            mut at: usize,
            distances: &[f32; WIDTH],
            places: &[u32; WIDTH],
            mask: u32,
        ) {
            for half in 0..2 {
                let (from, mask) = (8 * half, (mask >> (8 * half) & 255) as usize);
                let (to_distances, to_places) = (&mut to_distances[at..][..8], &mut to_places[at..][..8]);
                // SAFETY: only `avx2` searches by these kernels; the slices have eight elements, and so have the halves.
                unsafe {
                    let order = _mm256_loadu_si256(PACK[mask].as_ptr().cast());
                    let packed = _mm256_permutevar8x32_ps(_mm256_loadu_ps(distances.as_ptr().add(from)), order);
                    _mm256_storeu_ps(to_distances.as_mut_ptr(), packed);
                    let these = _mm256_loadu_si256(places.as_ptr().add(from).cast());
                    _mm256_storeu_si256(to_places.as_mut_ptr().cast(), _mm256_permutevar8x32_epi32(these, order));
                }
                at += mask.count_ones() as usize;
            }
        }

        #[inline(always)]
        fn append_leaf(to: (&mut [f32], &mut [u32]), mut at: usize, distances: &[f32; WIDTH], first: u32, mask: u32) {
            for half in 0..2 {
                let mask = (mask >> (8 * half) & 255) as usize;
                let (to_distances, to_places) = (&mut to.0[at..][..8], &mut to.1[at..][..8]);
                // SAFETY: only `avx2` searches by these kernels; the slices have eight elements, and so have the halves.
                unsafe {
                    let order = _mm256_loadu_si256(PACK[mask].as_ptr().cast());
                    let half_of_them = _mm256_loadu_ps(distances.as_ptr().add(8 * half as usize));
                    _mm256_storeu_ps(to_distances.as_mut_ptr(), _mm256_permutevar8x32_ps(half_of_them, order));
                    let places = _mm256_add_epi32(order, _mm256_set1_epi32((first + 8 * half) as i32));
                    _mm256_storeu_si256(to_places.as_mut_ptr().cast(), places);
                }
                at += mask.count_ones() as usize;
            }
        }

        #[inline(always)]
        fn pack(to: &mut [f32], mut at: usize, lanes: &[f32; WIDTH], mask: u32) {
            for half in 0..2 {
                let mask = (mask >> (8 * half) & 255) as usize;
                let to = &mut to[at..][..8];
                // SAFETY: only `avx2` and its like search by these kernels; the slice has eight elements, and so has the half.
                unsafe {
                    let order = _mm256_loadu_si256(PACK[mask].as_ptr().cast());
                    let these = _mm256_loadu_ps(lanes.as_ptr().add(8 * half as usize));
                    _mm256_storeu_ps(to.as_mut_ptr(), _mm256_permutevar8x32_ps(these, order));
                }
                at += mask.count_ones() as usize;
            }
        }

        #[inline(always)]
        fn append_numbers(to: &mut [u32], len: &mut usize, first: u32, mask: u32) {
            for half in 0..2 {
                let mask = (mask >> (8 * half) & 255) as usize;
                let room = &mut to[*len..][..8];
                // SAFETY: only `avx2` searches by these kernels; the slice has eight elements.
                unsafe {
                    let order = _mm256_loadu_si256(PACK[mask].as_ptr().cast());
                    let numbers = _mm256_add_epi32(order, _mm256_set1_epi32((first + 8 * half) as i32));
                    _mm256_storeu_si256(room.as_mut_ptr().cast(), numbers);
                }
                *len += mask.count_ones() as usize;
            }
        }
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;

    #[test]
    fn a_mask_of_sse_is_that_of_plain_comparisons() {
        let numbers = [0.0, -0.0, 1.0, f32::MIN_POSITIVE, f32::MAX, f32::INFINITY, f32::NAN];
        for bound in numbers {
            for first in 0..numbers.len() {
                let distances: [f32; WIDTH] =
                    std::array::from_fn(|lane| numbers[(first + lane * lane) % numbers.len()]);
                let (sse, plain) = (x86::Sse::within(&distances, bound), Plain::within(&distances, bound));
                assert_eq!(sse, plain, "{distances:?} within {bound}");
            }
        }
    }
}
