//! The k nearest of the candidates, without a heap: a distance is guessed, what lies within it is counted, and the few
//! about the k-th are told apart at the end.

use super::kernels::Kernels;
use crate::Nearest;
use crate::candidates::{Candidates, WIDTH};
use crate::nearest::{distance_of, id_of, rank};

/// Guesses by interpolation before halves are taken.
const GUESSES: usize = 8;
/// Halves of the 32 bits of a distance, and some.
const MOST_GUESSES: usize = GUESSES + 34;

/// A distance and how many candidates are at most so far.
type Counted = (f32, usize);

/// Puts the k nearest of the candidates of `found`, none of which is farther than `bound`, where its answer is.
#[inline(always)]
pub(super) fn select<K: Kernels>(found: &mut Nearest, bound: f32) {
    let (k, floor) = (found.k(), found.floor());
    let mut candidates = std::mem::take(&mut found.candidates);
    let farthest = if candidates.len > k {
        candidates.pad();
        let (sure, all) = split::<K>(&candidates, k, floor, bound);
        if all.1 - sure.1 <= WIDTH {
            part::<K>(&mut candidates, k, sure, all)
        } else if all.1 == k {
            keep::<K>(&mut candidates, all.0);
            farthest(&candidates)
        } else {
            shrink(&mut candidates, k)
        }
    } else {
        candidates.pad();
        farthest(&candidates)
    };
    found.settle(&candidates.distances[..candidates.len], &candidates.ids[..candidates.len], farthest);
    found.candidates = candidates;
}

/// Two distances between which the k-th lies: fewer than k are within the first, at least k within the second.
///
/// Interpolated on the value, since photons of a surface are spread evenly over squared distances; then halves of the bits.
#[inline(always)]
fn split<K: Kernels>(candidates: &Candidates, k: usize, floor: f32, bound: f32) -> (Counted, Counted) {
    let mut low = (-1.0, 0);
    let mut high = (bound, candidates.len);
    if floor > 0.0 && floor < bound {
        let sure = K::count(candidates.padded(), floor);
        if sure < k {
            low = (floor, sure);
        }
    }
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

/// Keeps the candidates within `bound`.
#[inline(always)]
fn keep<K: Kernels>(candidates: &mut Candidates, bound: f32) {
    let len = std::mem::take(&mut candidates.len);
    for from in (0..len).step_by(WIDTH) {
        let (distances, ids) = candidates.lanes(from);
        // What is written ends before what is read next.
        K::append(candidates, &distances, &ids, K::within(&distances, bound));
    }
}

/// Keeps the `sure`, and of the few others up to `all` as many, by distance and then id, as make k; the last of them.
#[inline(always)]
fn part<K: Kernels>(candidates: &mut Candidates, k: usize, sure: Counted, all: Counted) -> u64 {
    let mut shell = Candidates::default();
    shell.clear(WIDTH);
    let len = std::mem::take(&mut candidates.len);
    for from in (0..len).step_by(WIDTH) {
        let (distances, ids) = candidates.lanes(from);
        let inside = K::within(&distances, sure.0);
        let about = K::within(&distances, all.0) & !inside;
        if about != 0 {
            K::append(&mut shell, &distances, &ids, about);
        }
        K::append(candidates, &distances, &ids, inside);
    }
    let (distances, ids) = shell.lanes(0);
    let mut keys = [u64::MAX; WIDTH];
    for lane in 0..shell.len {
        keys[lane] = rank(distances[lane], ids[lane]);
    }
    let wanted = (k - candidates.len) as u64;
    let (mut chosen, mut last) = (0, 0);
    for lane in 0..shell.len {
        let mut rank = 0;
        for other in keys {
            rank += u64::from(other < keys[lane]);
        }
        chosen |= u32::from(rank < wanted) << lane;
        last = if rank + 1 == wanted { keys[lane] } else { last };
    }
    K::append(candidates, &distances, &ids, chosen);
    last
}

/// The farthest candidate; the largest id of equals. The room behind the last leaf is padded.
#[inline(always)]
fn farthest(candidates: &Candidates) -> u64 {
    let mut farthest = [0.0_f32; WIDTH];
    for lanes in candidates.padded() {
        for lane in 0..WIDTH {
            farthest[lane] = if lanes[lane] > farthest[lane] { lanes[lane] } else { farthest[lane] };
        }
    }
    let mut most = 0.0;
    for lane in farthest {
        most = if lane > most { lane } else { most };
    }
    let mut largest = 0;
    for at in 0..candidates.len {
        let id = if candidates.distances[at] == most { candidates.ids[at] } else { 0 };
        largest = if id > largest { id } else { largest };
    }
    rank(most, largest)
}

/// Keeps the k nearest of many candidates, whatever they are; the last of them.
#[cold]
pub(super) fn shrink(candidates: &mut Candidates, k: usize) -> u64 {
    let pairs = candidates.distances[..candidates.len].iter().zip(&candidates.ids);
    let mut keys: Vec<u64> = pairs.map(|(&distance, &id)| rank(distance, id)).collect();
    keys.select_nth_unstable(k - 1);
    for (at, key) in keys[..k].iter().enumerate() {
        candidates.distances[at] = distance_of(*key);
        candidates.ids[at] = id_of(*key);
    }
    candidates.len = k;
    keys[k - 1]
}
