//! One search for a group of neighbouring queries: what lies about all of them is collected, and each looks through that alone.

#![expect(clippy::needless_range_loop, reason = "loops over lanes, which compilers turn into vector code")]

use super::kernels::{Kernels, Work, leaf_distances};
use super::search::{Bounds, Leaves, walk};
use super::select::{kth, select};
use super::{LEAVES, WIDTH, WideTree};
use crate::candidates::{Candidates, Open, Room, most_candidates};
use crate::carry::Known;
use crate::geometry::distance_squared;
use crate::vicinity::{Ball, Vicinity};
use crate::{AccessObserver, Nearest};

/// Collects the photons among which the k nearest of every query in the ball are; `false` if they are too many, or k are not there.
pub(super) struct Collect<'a, E> {
    pub(super) tree: &'a WideTree,
    pub(super) ball: &'a Ball,
    pub(super) into: &'a mut Vicinity,
    pub(super) room: &'a mut Room,
    pub(super) eyes: &'a mut E,
}

impl<E: AccessObserver> Work for Collect<'_, E> {
    type Found = bool;

    #[inline(always)]
    fn run<K: Kernels>(self) -> bool {
        let Self { tree, ball, into, room, eyes } = self;
        into.clear(most_candidates(ball.k));
        into.centre = ball.centre;
        room.open();
        let reach = about(ball.enough, ball.spread);
        let mut all = All { into, bound: reach * reach, is_full: false };
        walk::<K>(tree, ball.centre, &mut all, &mut room.open, eyes);
        if all.is_full || into.near.len < ball.k {
            return false;
        }
        into.near.pad();
        let enough = ball.enough * ball.enough;
        if K::count(into.near.padded(), enough) < ball.k {
            return false;
        }
        into.kth = kth::<K>(&into.near, ball.k, Bounds { floor: -1.0, bound: reach * reach });
        keep::<K>(into, about(into.kth[1].sqrt(), ball.spread));
        true
    }
}

/// How far from the middle of a group the nearest photons of its queries are, if k are within `enough` of it.
fn about(enough: f32, spread: f32) -> f32 {
    Known::beside(spread, Known::beside(spread, enough).enough).enough
}

/// Keeps those within a distance of the middle.
#[inline(always)]
fn keep<K: Kernels>(into: &mut Vicinity, distance: f32) {
    let Vicinity { near, position, .. } = into;
    let mut len = 0;
    for from in (0..near.len).step_by(WIDTH) {
        let (distances, places) = near.lanes(from);
        let mask = K::within(&distances, distance * distance);
        // What is written lies where has been read.
        K::append_to((&mut near.distances, &mut near.places), len, &distances, &places, mask);
        for coordinates in &mut *position {
            let lanes: [f32; WIDTH] = coordinates[from..][..WIDTH].try_into().expect("sixteen lanes");
            K::pack(coordinates, len, &lanes, mask);
        }
        len += mask.count_ones() as usize;
    }
    near.len = len;
    into.pad();
}

/// Takes all photons within a bound.
struct All<'a> {
    into: &'a mut Vicinity,
    bound: f32,
    is_full: bool,
}

impl Leaves for All<'_> {
    #[inline(always)]
    fn bound(&self) -> f32 {
        self.bound
    }

    #[inline(always)]
    fn read<K: Kernels>(
        &mut self,
        tree: &WideTree,
        point: [f32; 3],
        open: &Open,
        eyes: &mut impl AccessObserver,
    ) -> bool {
        let Vicinity { near, position, .. } = &mut *self.into;
        let most = near.most();
        let mut len = near.len;
        for &number in &open.numbers[..open.len] {
            if len > most {
                self.is_full = true;
                return false;
            }
            eyes.read(LEAVES, number);
            eyes.examined(WIDTH);
            let leaf = &tree.leaves[number as usize];
            let distances = leaf_distances(leaf, point);
            let mask = K::within(&distances, self.bound);
            K::append_leaf((&mut near.distances, &mut near.places), len, &distances, number * WIDTH as u32, mask);
            for axis in 0..3 {
                K::pack(&mut position[axis], len, &leaf.position[axis], mask);
            }
            len += mask.count_ones() as usize;
        }
        near.len = len;
        self.is_full = len > most;
        !self.is_full
    }
}

/// Finds the photons nearest to a query of the group, within the largest distance that counts.
pub(super) struct LookThrough<'a> {
    pub(super) tree: &'a WideTree,
    pub(super) vicinity: &'a Vicinity,
    pub(super) point: [f32; 3],
    pub(super) max_dist: f32,
    pub(super) found: &'a mut Nearest,
}

impl Work for LookThrough<'_> {
    type Found = ();

    #[inline(always)]
    fn run<K: Kernels>(self) {
        let Self { tree, vicinity, point, max_dist, found } = self;
        let between = distance_squared(vicinity.centre, point).sqrt();
        let inside = Known::beside(between, vicinity.kth[0].sqrt()).inside;
        let enough = Known::beside(between, vicinity.kth[1].sqrt()).enough.min(max_dist);
        found.restart_between(inside * inside.abs(), enough * enough);
        let bounds = Bounds { floor: found.floor(), bound: found.bound() };
        let k = found.k();
        let Room { chosen, shell, .. } = &mut found.room;
        chosen.clear(k + WIDTH);
        shell.clear(most_candidates(k));
        share::<K>(vicinity, point, bounds, chosen, shell);
        select::<K>(found, bounds, &tree.ids);
    }
}

/// Shares photons out among those that are sure and those that may be.
#[inline(always)]
fn share<K: Kernels>(
    vicinity: &Vicinity,
    point: [f32; 3],
    bounds: Bounds,
    chosen: &mut Candidates,
    shell: &mut Candidates,
) {
    let [x, y, z] = &vicinity.position;
    let (mut chosen_len, mut shell_len) = (0, 0);
    for from in (0..vicinity.near.len).step_by(WIDTH) {
        let (x, y, z) = (&x[from..][..WIDTH], &y[from..][..WIDTH], &z[from..][..WIDTH]);
        let mut distances = [0.0; WIDTH];
        for lane in 0..WIDTH {
            distances[lane] = distance_squared(point, [x[lane], y[lane], z[lane]]);
        }
        let places: [u32; WIDTH] = vicinity.near.places[from..][..WIDTH].try_into().expect("sixteen lanes");
        let near = K::within(&distances, bounds.bound);
        let sure = near & K::within(&distances, bounds.floor);
        K::append_to((&mut chosen.distances, &mut chosen.places), chosen_len, &distances, &places, sure);
        chosen_len += sure.count_ones() as usize;
        K::append_to((&mut shell.distances, &mut shell.places), shell_len, &distances, &places, near & !sure);
        shell_len += (near & !sure).count_ones() as usize;
    }
    (chosen.len, shell.len) = (chosen_len, shell_len);
}
