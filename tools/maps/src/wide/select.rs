//! The k nearest of the candidates, without a heap: a distance is guessed, what lies within it is counted, and the few
//! about the k-th are told apart at the end.

use super::kernels::Kernels;
use super::search::Bounds;
use crate::Nearest;
use crate::candidates::{Candidates, Room, WIDTH};
use crate::nearest::rank;
use std::sync::Arc;

/// Guesses by interpolation before halves are taken.
const GUESSES: usize = 8;
/// Halves of the 32 bits of a distance, and some.
const MOST_GUESSES: usize = GUESSES + 34;

/// A distance and how many candidates are at most so far.
type Counted = (f32, usize);

/// Puts the k nearest where the answer of `found` is; `ids` are those of the photons by their places.
#[inline(always)]
pub(super) fn select<K: Kernels>(found: &mut Nearest, bounds: Bounds, ids: &Arc<[u32]>) {
    let k = found.k();
    let Room { chosen, shell, .. } = &mut found.room;
    // None, unless rounding has made too many sure.
    let wanted = k - chosen.len.min(k);
    shell.pad();
    let farthest = if shell.len > wanted && wanted > 0 {
        let (sure, all) = split::<K>(shell, wanted, bounds);
        if all.1 - sure.1 <= WIDTH {
            part::<K>(shell, wanted, sure, all, chosen, ids)
        } else {
            if all.1 != wanted {
                shell.shrink(wanted, ids);
                shell.pad();
            }
            take::<K>(shell, all.0, chosen);
            farthest(shell, all.0, ids)
        }
    } else if wanted > 0 && shell.len > 0 {
        take::<K>(shell, f32::INFINITY, chosen);
        farthest(shell, f32::INFINITY, ids)
    } else {
        chosen.pad();
        farthest(chosen, f32::INFINITY, ids)
    };
    found.settle(farthest, ids);
}

/// Two distances between which the k-th lies: fewer than k are within the first, at least k within the second.
///
/// Interpolated on the value, since photons of a surface are spread evenly over squared distances; then halves of the bits.
#[inline(always)]
fn split<K: Kernels>(candidates: &Candidates, k: usize, bounds: Bounds) -> (Counted, Counted) {
    let mut low = (bounds.floor.max(-1.0), 0);
    let mut high = (bounds.bound, candidates.len);
    for step in 0..MOST_GUESSES {
        if high.1 - low.1 <= WIDTH {
            break;
        }
        let from = low.0.max(0.0);
        let guess = if step < GUESSES && high.0 < f32::INFINITY {
            from + (high.0 - from) * ((k - low.1) as f32 / (high.1 - low.1) as f32)
        } else {
            f32::from_bits(u32::midpoint(from.to_bits(), high.0.to_bits()))
        };
        // Where nothing lies between the two, all that is left is as far.
        if !(guess > low.0 && guess < high.0) {
            if step < GUESSES {
                continue;
            }
            break;
        }
        let counted = (guess, K::count(candidates.padded(), guess));
        if counted.1 >= k { high = counted } else { low = counted }
    }
    (low, high)
}

/// Squared distances about the k-th of the candidates, which are padded: at most k are within the first, at least k within the second.
#[inline(always)]
pub(super) fn kth<K: Kernels>(candidates: &Candidates, k: usize, bounds: Bounds) -> [f32; 2] {
    let (low, high) = split::<K>(candidates, k, bounds);
    if high.1 - low.1 > WIDTH {
        return [low.0, high.0];
    }
    let (mut rim, mut numbers, mut len) = ([f32::NAN; 2 * WIDTH], [0; 2 * WIDTH], 0);
    for from in (0..candidates.len).step_by(WIDTH) {
        let (distances, places) = candidates.lanes(from);
        let about = K::within(&distances, high.0) & !K::within(&distances, low.0);
        K::append_to((&mut rim, &mut numbers), len, &distances, &places, about);
        len += about.count_ones() as usize;
    }
    rim[..len].sort_unstable_by(f32::total_cmp);
    [rim[k - 1 - low.1]; 2]
}

/// Takes the candidates within `bound`.
#[inline(always)]
fn take<K: Kernels>(candidates: &Candidates, bound: f32, chosen: &mut Candidates) {
    for from in (0..candidates.len).step_by(WIDTH) {
        let (distances, places) = candidates.lanes(from);
        K::append(chosen, &distances, &places, K::within(&distances, bound));
    }
}

/// Takes the `sure`, and of the few others up to `all` as many, by distance and then id, as make k; the last of them.
#[inline(always)]
fn part<K: Kernels>(
    shell: &Candidates,
    k: usize,
    sure: Counted,
    all: Counted,
    chosen: &mut Candidates,
    ids: &[u32],
) -> (f32, u32) {
    let (mut rim, mut numbers, mut len) = ([f32::NAN; 2 * WIDTH], [0; 2 * WIDTH], 0);
    for from in (0..shell.len).step_by(WIDTH) {
        let (distances, places) = shell.lanes(from);
        let inside = K::within(&distances, sure.0);
        let about = K::within(&distances, all.0) & !inside;
        K::append_to((&mut rim, &mut numbers), len, &distances, &places, about);
        len += about.count_ones() as usize;
        K::append(chosen, &distances, &places, inside);
    }
    let mut distances = [f32::NAN; WIDTH];
    for lane in 0..WIDTH {
        distances[lane] = if lane < len { rim[lane] } else { f32::NAN };
    }
    let places: [u32; WIDTH] = numbers[..WIDTH].try_into().expect("sixteen lanes");
    let wanted = (k - sure.1) as u32;
    // How many are as near as each: small numbers, which floats are good for as well.
    let mut as_near = [0.0_f32; WIDTH];
    for other in 0..WIDTH {
        for lane in 0..WIDTH {
            as_near[lane] += if distances[other] <= distances[lane] { 1.0 } else { 0.0 };
        }
    }
    let mut nearer = K::within(&as_near, wanted as f32) & ((1 << len) - 1);
    let mut last = nearer & !K::within(&as_near, wanted as f32 - 1.0);
    if last.count_ones() != 1 {
        (nearer, last) = by_ids(&distances, &places, len, wanted, ids);
    }
    K::append(chosen, &distances, &places, nearer);
    let last = last.trailing_zeros() as usize % WIDTH;
    (distances[last], places[last])
}

/// The nearest `wanted` by distance and then id, and the last of them, where some are equally far.
#[cold]
fn by_ids(distances: &[f32; WIDTH], places: &[u32; WIDTH], len: usize, wanted: u32, ids: &[u32]) -> (u32, u32) {
    let mut keys: Vec<(u64, usize)> =
        (0..len).map(|lane| (rank(distances[lane], ids[places[lane] as usize]), lane)).collect();
    keys.sort_unstable();
    let nearest = &keys[..wanted as usize];
    let bit = |&(_, lane): &(u64, usize)| 1 << lane;
    (nearest.iter().map(bit).sum(), nearest.last().map_or(0, bit))
}

/// The farthest candidate within a bound; the largest id of equals. The room behind the last is padded.
#[inline(always)]
fn farthest(candidates: &Candidates, bound: f32, ids: &[u32]) -> (f32, u32) {
    let mut farthest = [0.0_f32; WIDTH];
    for lanes in candidates.padded() {
        for lane in 0..WIDTH {
            let larger = lanes[lane] > farthest[lane] && lanes[lane] <= bound;
            farthest[lane] = if larger { lanes[lane] } else { farthest[lane] };
        }
    }
    let mut most = 0.0;
    for lane in farthest {
        most = if lane > most { lane } else { most };
    }
    (most, last_at(candidates, most, ids))
}

/// The place of the candidate at this distance; of several, of that with the largest id.
#[cold]
fn last_at(candidates: &Candidates, distance: f32, ids: &[u32]) -> u32 {
    let at = candidates.iter().filter(|candidate| candidate.0 == distance).map(|candidate| candidate.1);
    at.max_by_key(|&place| ids[place as usize]).unwrap_or(0)
}
