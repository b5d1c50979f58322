//! The search of a ray through the eight-wide hierarchy.

use super::lanes::{LANES, Lanes, Work};
use super::ray::{Ray, RayHit};
use super::sheared::Sheared;
use super::wide::{Child, Leaf, Node, Wide};

/// The first triangle that a ray meets, and whether another is at the very same distance.
pub(super) struct First {
    pub(super) hit: RayHit,
    pub(super) tied: bool,
}

/// Looks for the first triangle at `0 < t <= far`.
pub(super) struct Closest<'a>(pub(super) &'a Wide, pub(super) Ray);

/// Looks for the first triangle of each ray, and tells of them in order.
pub(super) struct ClosestEach<'a, T: FnMut(Option<First>)>(pub(super) &'a Wide, pub(super) &'a [Ray], pub(super) T);

/// Looks for any triangle at `0 < t < far`.
pub(super) struct Blocked<'a>(pub(super) &'a Wide, pub(super) Ray);

impl Work for Closest<'_> {
    type Found = Option<First>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Found {
        let Self(wide, ray) = self;
        // Of the first so far: leaf, lane, t, and weights of the second and third corner with what they are to be divided by.
        let mut first: Option<(usize, usize, [f32; 4])> = None;
        let mut tied = false;
        visit::<L>(wide, ray, |leaf, lanes, hits, mut nearest| {
            for lane in set_bits(lanes) {
                let t = hits.t[lane];
                if t < nearest || first.is_none() && t == nearest {
                    (nearest, tied) = (t, false);
                    first = Some((leaf, lane, [t, hits.v[lane], hits.w[lane], hits.determinant[lane]]));
                } else if t == nearest {
                    tied = true;
                }
            }
            Some(nearest)
        });
        let (leaf, lane, [t, v, w, determinant]) = first?;
        let triangle = wide.leaves[leaf].triangles[lane];
        Some(First { hit: RayHit { triangle, t, u: v / determinant, v: w / determinant }, tied })
    }
}

impl<T: FnMut(Option<First>)> Work for ClosestEach<'_, T> {
    type Found = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self(wide, rays, mut tell) = self;
        for ray in rays {
            tell(Closest(wide, *ray).run::<L>());
        }
    }
}

impl Work for Blocked<'_> {
    type Found = bool;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Found {
        let Self(wide, ray) = self;
        let mut blocked = false;
        visit::<L>(wide, ray, |_, lanes, hits, nearest| {
            blocked = set_bits(lanes).any(|lane| hits.t[lane] < ray.far);
            (!blocked).then_some(nearest)
        });
        blocked
    }
}

/// Of a leaf's triangles that a ray meets: at which `t`, and the weights of their second and third corners before they are
/// divided by the determinant, which only that of the first is.
struct Hits {
    t: [f32; LANES],
    v: [f32; LANES],
    w: [f32; LANES],
    determinant: [f32; LANES],
}

/// Calls `meet` for leaves on the way of a ray, nearer boxes first, with a leaf's number, the triangles met there and how far
/// to look; it says how far to look from then on, or that this is the end.
#[inline(always)]
fn visit<L: Lanes>(wide: &Wide, ray: Ray, mut meet: impl FnMut(usize, u32, &Hits, f32) -> Option<f32>) {
    if wide.nodes.is_empty() {
        return;
    }
    let slabs = Slabs::new(&ray);
    let sheared = Sheared::new(ray.origin, ray.direction);
    let mut waiting = Waiting::new();
    let mut hits = Hits { t: [0.0; LANES], v: [0.0; LANES], w: [0.0; LANES], determinant: [0.0; LANES] };
    let (mut child, mut nearest) = (Child::ROOT, ray.far);
    loop {
        match child.place() {
            Ok(node) => {
                let node = &wide.nodes[node];
                let (t, lanes) = slabs.enter::<L>(node, nearest);
                if lanes != 0 {
                    child = waiting.put_all_but_nearest(node, &t, lanes);
                    continue;
                }
            }
            Err(leaf) => {
                let lanes = triangles::<L>(&wide.leaves[leaf], &sheared, nearest, &mut hits);
                if lanes != 0 {
                    let Some(until) = meet(leaf, lanes, &hits, nearest) else { return };
                    nearest = until;
                }
            }
        }
        let Some(next) = waiting.next(nearest) else { return };
        child = next;
    }
}

/// A ray as boxes see it.
struct Slabs {
    origin: [f32; 3],
    inverse: [f32; 3],
    /// Of each axis, which of a box's planes comes first: the one with the smaller coordinate, or the other.
    first: [usize; 3],
}

impl Slabs {
    #[inline(always)]
    fn new(ray: &Ray) -> Self {
        // Along a plane a ray gets nowhere, but a multiple of 0 must be a number.
        let inverse = |along: f32| if along.abs() < 1e-30 { f32::copysign(1e30, along) } else { 1.0 / along };
        let inverse = ray.direction.to_array().map(inverse);
        Self { origin: ray.origin.into(), inverse, first: inverse.map(|along| usize::from(along < 0.0)) }
    }

    /// Where the ray enters each box, and a bit for every box that it enters at most so far away: `t` is the largest of
    /// where it passes the first planes, and has to be at most the smallest of where it passes the second.
    #[inline(always)]
    fn enter<L: Lanes>(&self, node: &Node, nearest: f32) -> ([f32; LANES], u32) {
        let (mut enter, mut leave) = (L::splat(0.0), L::splat(nearest));
        for axis in 0..3 {
            enter = self.pass::<L>(node, axis, self.first[axis]).max(enter);
            leave = self.pass::<L>(node, axis, self.first[axis] ^ 1).min(leave);
        }
        (enter.store(), enter.at_most(leave))
    }

    /// Where the ray passes these planes of the boxes.
    #[inline(always)]
    fn pass<L: Lanes>(&self, node: &Node, axis: usize, planes: usize) -> L {
        let planes = L::load(&node.planes[axis][planes & 1]);
        planes.minus(L::splat(self.origin[axis])).times(L::splat(self.inverse[axis]))
    }
}

/// [`Sheared::hit`] of a leaf's triangles side by side, by the same operations in the same order. Returns a bit for each
/// that is met, and says of those where.
#[inline(always)]
fn triangles<L: Lanes>(leaf: &Leaf, ray: &Sheared, far: f32, hits: &mut Hits) -> u32 {
    let [a, b, c] = [Corner::<L>::new(leaf, 0, ray), Corner::new(leaf, 1, ray), Corner::new(leaf, 2, ray)];
    let (u, v, w) = (c.cross(b), a.cross(c), b.cross(a));
    let zero = L::splat(0.0);
    // Of one sign, or 0.
    let (smallest, largest) = (u.min(v).min(w), u.max(v).max(w));
    let inside = zero.at_most(smallest) | largest.at_most(zero);
    // Where one is 0 as far as single precision can tell; of squares, for they have no sign.
    let on_edge = u.times(u).min(v.times(v)).min(w.times(w)).at_most(zero);
    if inside | on_edge == 0 {
        return 0;
    }
    let determinant = u.plus(v).plus(w);
    let t = L::splat(ray.shear[2]).times(u.times(a.z).plus(v.times(b.z)).plus(w.times(c.z))).over(determinant);
    let mut lanes = inside & t.at_most(L::splat(far)) & !t.at_most(zero);
    *hits = Hits { t: t.store(), v: v.store(), w: w.store(), determinant: determinant.store() };
    for lane in set_bits(on_edge) {
        let hit = ray.hit(&leaf.triangle(lane), far);
        lanes = lanes & !(1 << lane) | u32::from(hit.is_some()) << lane;
        if let Some((t, v, w)) = hit {
            (hits.t[lane], hits.v[lane], hits.w[lane], hits.determinant[lane]) = (t, v, w, 1.0);
        }
    }
    lanes
}

/// A corner of each of a leaf's triangles as the ray sees it. No closures: what is called in one is not made of the
/// instructions of the function around it.
#[derive(Clone, Copy)]
struct Corner<L> {
    x: L,
    y: L,
    z: L,
}

impl<L: Lanes> Corner<L> {
    #[inline(always)]
    fn new(leaf: &Leaf, corner: usize, ray: &Sheared) -> Self {
        let z = Self::along(leaf, corner, ray, 2);
        Self {
            x: Self::along(leaf, corner, ray, 0).minus(L::splat(ray.shear[0]).times(z)),
            y: Self::along(leaf, corner, ray, 1).minus(L::splat(ray.shear[1]).times(z)),
            z,
        }
    }

    /// From the ray's origin, along what it calls its first, second or third axis.
    #[inline(always)]
    fn along(leaf: &Leaf, corner: usize, ray: &Sheared, axis: usize) -> L {
        L::load(leaf.row(corner, ray.axes[axis])).minus(L::splat(ray.origin[axis]))
    }

    #[inline(always)]
    fn cross(self, other: Self) -> L {
        self.x.times(other.y).minus(self.y.times(other.x))
    }
}

/// The lanes of a mask.
#[inline(always)]
fn set_bits(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = mask.trailing_zeros() as usize;
        mask &= mask.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    })
}

/// Boxes still to be looked into and where the ray enters them, the next one last.
struct Waiting {
    few: [(Child, f32); Self::FEW],
    len: usize,
    /// Those before the few: of most rays none.
    more: Vec<(Child, f32)>,
}

impl Waiting {
    const FEW: usize = 32;

    #[inline(always)]
    const fn new() -> Self {
        Self { few: [(Child::ROOT, 0.0); Self::FEW], len: 0, more: vec![] }
    }

    /// Puts what is in these of a node's boxes, but for the nearest, which it returns.
    #[inline(always)]
    fn put_all_but_nearest(&mut self, node: &Node, t: &[f32; LANES], lanes: u32) -> Child {
        if self.len + LANES > Self::FEW {
            self.more.extend_from_slice(&self.few[..self.len]);
            self.len = 0;
        }
        let bottom = self.len;
        let mut nearest: Option<(Child, f32)> = None;
        for lane in set_bits(lanes) {
            let mut one = (node.children[lane], t[lane]);
            let Some(other) = &mut nearest else {
                nearest = Some(one);
                continue;
            };
            if one.1 < other.1 {
                std::mem::swap(&mut one, other);
            }
            let mut at = self.len;
            while at > bottom && self.few[at - 1].1 < one.1 {
                self.few[at] = self.few[at - 1];
                at -= 1;
            }
            self.few[at] = one;
            self.len += 1;
        }
        nearest.map_or(Child::ROOT, |(child, _)| child)
    }

    /// The next box that is entered at most so far away.
    #[inline(always)]
    fn next(&mut self, nearest: f32) -> Option<Child> {
        loop {
            let (child, t) = match self.len.checked_sub(1) {
                Some(last) => {
                    self.len = last;
                    self.few[last % Self::FEW]
                }
                None => self.more.pop()?,
            };
            if t <= nearest {
                return Some(child);
            }
        }
    }
}
