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
        closest::<L>(self.0, &Prepared::new(&self.1))
    }
}

#[inline(always)]
fn closest<L: Lanes>(wide: &Wide, ray: &Prepared) -> Option<First> {
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

impl<T: FnMut(Option<First>)> Work for ClosestEach<'_, T> {
    type Found = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self(wide, rays, mut tell) = self;
        // Some are prepared at a time, none of which has to wait for where another ends.
        let Some(first) = rays.first() else { return };
        let mut prepared = [Prepared::new(first); AT_A_TIME];
        for rays in rays.chunks(AT_A_TIME) {
            for (prepared, ray) in prepared.iter_mut().zip(rays) {
                *prepared = Prepared::new(ray);
            }
            for ray in &prepared[..rays.len()] {
                tell(closest::<L>(wide, ray));
            }
        }
    }
}

impl Work for Blocked<'_> {
    type Found = bool;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Found {
        let Self(wide, ray) = self;
        let mut blocked = false;
        visit::<L>(wide, &Prepared::new(&ray), |_, lanes, hits, nearest| {
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
fn visit<L: Lanes>(wide: &Wide, ray: &Prepared, mut meet: impl FnMut(usize, u32, &Hits, f32) -> Option<f32>) {
    if wide.nodes.is_empty() {
        return;
    }
    let Prepared { slabs, sheared, far } = ray;
    let mut waiting = Waiting::new();
    let mut hits = Hits { t: [0.0; LANES], v: [0.0; LANES], w: [0.0; LANES], determinant: [0.0; LANES] };
    let (mut child, mut nearest) = (Child::ROOT, *far);
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
                let Some(triangles_of) = wide.leaves.get(leaf) else {
                    // The end, which is no leaf's number.
                    if waiting.more.is_empty() {
                        return;
                    }
                    let Some(next) = waiting.next_of_more(nearest) else { return };
                    child = next;
                    continue;
                };
                let lanes = triangles::<L>(triangles_of, sheared, nearest, &mut hits);
                if lanes != 0 {
                    let Some(until) = meet(leaf, lanes, &hits, nearest) else { return };
                    nearest = until;
                }
            }
        }
        child = waiting.next(nearest);
    }
}

/// A ray as boxes and triangles see it.
#[derive(Clone, Copy)]
struct Prepared {
    slabs: Slabs,
    sheared: Sheared,
    far: f32,
}

/// Rays that are prepared before the first of them is cast.
const AT_A_TIME: usize = 8;

impl Prepared {
    #[inline(always)]
    fn new(ray: &Ray) -> Self {
        Self { slabs: Slabs::new(ray), sheared: Sheared::new(ray.origin, ray.direction), far: ray.far }
    }
}

/// A ray as boxes see it.
#[derive(Clone, Copy)]
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
        // Of equals `max` takes the second: a plane that is passed at -0 leaves 0, as an [`Entry`] needs it.
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

/// Boxes still to be looked into, the next one last.
struct Waiting {
    /// The first stands for the end of them.
    few: [Entry; Self::FEW],
    len: usize,
    /// Those before the few: of most rays none.
    more: Vec<Entry>,
}

/// Where a ray enters a box, and what is in it, as one number: the nearer box is the smaller one, for the bits of numbers that
/// are not negative go up with them. Of two the smaller is told without a branch, which no machine could foresee.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Entry(u64);

impl Entry {
    const NONE: Self = Self(u64::MAX);

    #[inline(always)]
    fn new(t: f32, child: Child) -> Self {
        Self(u64::from(t.to_bits()) << 32 | u64::from(child.bits()))
    }

    #[inline(always)]
    const fn child(self) -> Child {
        Child::from_bits(self.0 as u32)
    }
}

impl Waiting {
    const FEW: usize = 32;

    #[inline(always)]
    fn new() -> Self {
        Self { few: [Entry::new(0.0, Child::END); Self::FEW], len: 1, more: vec![] }
    }

    /// Puts what is in these of a node's boxes, of which there is one, but for the nearest, which it returns.
    #[inline(always)]
    fn put_all_but_nearest(&mut self, node: &Node, t: &[f32; LANES], lanes: u32) -> Child {
        if self.len + LANES > Self::FEW {
            self.more.extend_from_slice(&self.few[1..self.len]);
            self.len = 1;
        }
        let entry = |lanes: u32| {
            let lane = lanes.trailing_zeros() as usize % LANES;
            Entry::new(t[lane], node.children[lane])
        };
        let but_one = |lanes: u32| lanes & lanes.wrapping_sub(1);
        // Mostly there are one or two.
        let (first, mut rest) = (entry(lanes), but_one(lanes));
        let second = if rest == 0 { Entry::NONE } else { entry(rest) };
        let mut nearest = first.min(second);
        let bottom = self.len;
        self.few[bottom % Self::FEW] = first.max(second);
        self.len += usize::from(rest != 0);
        rest = but_one(rest);
        while rest != 0 {
            let one = entry(rest);
            rest = but_one(rest);
            let further = nearest.max(one);
            nearest = nearest.min(one);
            let mut at = self.len;
            while at > bottom && self.few[(at - 1) % Self::FEW] < further {
                self.few[at % Self::FEW] = self.few[(at - 1) % Self::FEW];
                at -= 1;
            }
            self.few[at % Self::FEW] = further;
            self.len += 1;
        }
        nearest.child()
    }

    /// The next box that is entered at most so far away, or the end of the few.
    #[inline(always)]
    fn next(&mut self, nearest: f32) -> Child {
        let until = Entry(u64::from(nearest.to_bits()) << 32 | u64::from(u32::MAX));
        loop {
            self.len -= 1;
            let entry = self.few[self.len % Self::FEW];
            if entry <= until {
                return entry.child();
            }
        }
    }

    /// The next box before the few, once their end has come.
    #[cold]
    fn next_of_more(&mut self, nearest: f32) -> Option<Child> {
        self.len = 1;
        let until = Entry(u64::from(nearest.to_bits()) << 32 | u64::from(u32::MAX));
        std::iter::from_fn(|| self.more.pop()).find(|&entry| entry <= until).map(Entry::child)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    #[test]
    fn all_boxes_that_wait_come_again_the_nearest_of_each_node_first() {
        let mut random = Random::new(&[6]);
        for nodes in [1, 3, 4, 5, 40] {
            for nearest in [f32::INFINITY, 0.5] {
                let mut waiting = Waiting::new();
                let mut expected = vec![];
                for node in 0..nodes {
                    let children = std::array::from_fn(|lane| Child::from_bits(node * 8 + lane as u32));
                    let boxes = Node { planes: [[[0.0; LANES]; 2]; 3], children };
                    let t: [f32; LANES] = std::array::from_fn(|_| random.unit());
                    let lanes = 1 + random.next_u64() as u32 % 255;
                    let mut entered: Vec<_> = set_bits(lanes).map(|lane| (t[lane], children[lane].bits())).collect();
                    entered.sort_by(|a, b| a.0.total_cmp(&b.0));
                    assert_eq!(waiting.put_all_but_nearest(&boxes, &t, lanes).bits(), entered[0].1);
                    // The last node's come first.
                    expected.splice(0..0, entered.into_iter().skip(1));
                }
                let mut found = vec![];
                loop {
                    let child = waiting.next(nearest);
                    if child.bits() != Child::END.bits() {
                        found.push(child.bits());
                        continue;
                    }
                    let Some(next) = waiting.next_of_more(nearest) else { break };
                    found.push(next.bits());
                }
                let near = expected.iter().filter(|&&(t, _)| t <= nearest).map(|&(_, child)| child);
                assert_eq!(found, near.collect::<Vec<_>>(), "{nodes} nodes, up to {nearest}");
            }
        }
    }
}
