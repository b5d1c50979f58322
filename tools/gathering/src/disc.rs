//! Which part of the photons' disc lies on the query's own surface.
//!
//! Near an edge the disc reaches beyond the surface. Photons of the surface round the corner, which the estimate leaves
//! out, show where: the plane of each cuts the disc. What lies beyond a cut is left out of the area *and* of the sum, so
//! wherever the cuts are the estimate is unbiased on an even density; a cut in the wrong place only wastes photons.
//!
//! The problem is the boundary bias of Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 7.2, who
//! leaves it; convex hulls of the photons found are the usual cure, but shrink the area everywhere.

mod around;
mod slope;

pub(super) use around::Around;
pub(super) use slope::Slope;

use super::kernel::Kernel;
use super::surface::Surface;
use glam::DVec3;
use std::f64::consts::TAU;

/// A room has three walls in a corner, so two cuts; the rest is for what stands in it.
const MOST_CUTS: usize = 4;
/// A photon this many radii or less inside a cut lies on it: packed normals are some 2 degrees off.
const ON_THE_PLANE: f64 = 1.0 / 16.0;
/// Planes that meet the query's at a smaller angle (its sine) do not cut it: the backs of thin walls, above all.
const LEAST_SINE: f64 = 0.4;
/// At this distance half as large a circle of an edge's other surface lies within the photons' ball as of the query's own.
const SURELY_SEEN: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A straight cut through the disc, all lengths in radii.
#[derive(Clone, Copy, Debug)]
struct Cut {
    /// Unit normal of the cutting plane, towards the query.
    normal: DVec3,
    /// Distance of the plane from the query, in space.
    height: f64,
    /// Distance of the cut from the query, in the disc.
    distance: f64,
    /// Direction in the disc towards the cut, as an angle from that of the first cut.
    angle: f64,
    /// The same as a vector.
    towards: DVec3,
}

/// The photons' disc around a query, without what lies beyond its cuts.
#[derive(Clone, Debug)]
pub(super) struct Disc {
    normal: DVec3,
    cuts: Vec<Cut>,
}

/// A plane that cuts the disc.
#[derive(Clone, Copy, Debug)]
struct Plane {
    /// Unit normal, towards the query.
    normal: DVec3,
    /// Distance from the query, in radii.
    height: f64,
    /// The part of the normal that lies in the disc, and its length.
    along: DVec3,
    sine: f64,
}

/// A photon that does not lie on the query's surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stranger {
    /// Squared distance and id, which decide who is nearer.
    pub(super) rank: (f32, u32),
    /// Position relative to the query, in radii.
    pub(super) offset: DVec3,
    /// Unit normal.
    pub(super) normal: DVec3,
}

impl Disc {
    /// The disc of a query whose surface has this unit normal.
    pub(super) const fn new(normal: DVec3) -> Self {
        Self { normal, cuts: vec![] }
    }

    /// Cuts the disc where the surfaces of strangers meet it, nearest first, each unless it lies beyond the cuts before it, and takes
    /// away what lies beyond them. `stranger` says more of one of those `around`.
    pub(super) fn cut(&mut self, surface: &Surface, around: &mut Around, stranger: impl Fn(&Around, u32) -> Stranger) {
        self.cut_up_to(MOST_CUTS, surface, around, stranger);
    }

    /// The same with this many cuts at most.
    pub(super) fn cut_up_to(
        &mut self,
        most: usize,
        surface: &Surface,
        around: &mut Around,
        stranger: impl Fn(&Around, u32) -> Stranger,
    ) {
        while self.cuts.len() < most {
            let mut nearest: Option<(f32, Stranger, Plane)> = None;
            // The nearest is asked first: then most of the others are too far to be asked more than that.
            let distance = |number: u32| around.distances[number as usize];
            let first = around.strangers().iter().copied().min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            for number in first.into_iter().chain(around.strangers().iter().copied()) {
                let distance = distance(number);
                if nearest.is_some_and(|(nearest, ..)| distance > nearest) {
                    continue;
                }
                let one = stranger(around, number);
                if nearest.is_none_or(|(_, nearest, _)| one.is_nearer(&nearest))
                    && let Some(plane) = self.plane(&one)
                {
                    nearest = Some((distance, one, plane));
                }
            }
            let Some((.., plane)) = nearest else { break };
            let cut = self.cut_by(plane);
            self.cuts.push(cut);
            around.take_away(surface, &cut);
        }
    }

    /// The plane of a photon's surface, if it reaches the disc.
    fn plane(&self, stranger: &Stranger) -> Option<Plane> {
        let height = -stranger.normal.dot(stranger.offset);
        // At a convex edge the query is behind the other surface: the plane is the same.
        let (normal, height) = if height < 0.0 { (-stranger.normal, -height) } else { (stranger.normal, height) };
        let along = normal - self.normal * normal.dot(self.normal);
        let sine = along.length();
        (sine >= LEAST_SINE && height < sine).then_some(Plane { normal, height, along, sine })
    }

    /// The cut that a plane makes.
    fn cut_by(&self, Plane { normal, height, along, sine }: Plane) -> Cut {
        let towards = along / -sine;
        let angle = self.cuts.first().map_or(0.0, |first| {
            libm::atan2(self.normal.dot(first.towards.cross(towards)), first.towards.dot(towards))
        });
        Cut { normal, height, distance: height / sine, angle, towards }
    }

    /// The planes that cut it: unit normal towards the middle, and the middle's distance from the plane in radii.
    pub(super) fn planes(&self) -> impl Iterator<Item = (DVec3, f64)> {
        self.cuts.iter().map(|cut| (cut.normal, cut.height))
    }

    /// How far the query is from the nearest plane that cuts the disc, in radii; if none does, as far as a plane would surely
    /// be shown by some photons. So far all around it is as here.
    pub(super) fn reach(&self) -> f64 {
        self.cuts.iter().map(|cut| cut.height).fold(SURELY_SEEN, f64::min)
    }

    /// Integral of the kernel's weight over the disc, in squared radii: its area, for the constant kernel.
    pub(super) fn integral(&self, kernel: Kernel) -> f64 {
        let mut sum = 0.0;
        match &self.cuts[..] {
            [] => return kernel.disc(),
            // The usual case, in which it is known without asking which border is where.
            [cut] if cut.angle == 0.0 && (1e-6..1.0 - 1e-6).contains(&cut.distance) => {
                let half = libm::acos(cut.distance);
                for (from, to, border) in
                    [(0.0, half, Some(cut)), (half, TAU - half, None), (TAU - half, TAU, Some(cut))]
                {
                    sum += sector(kernel, from, to, border);
                }
                return sum;
            }
            _ => {}
        }
        self.sectors(|from, to, border| sum += sector(kernel, from, to, border));
        sum
    }

    /// Calls `visit` with the angles between which the border does not change, one pair after the other, and with the cut
    /// that the border is there; with `None` where it is the rim.
    fn sectors(&self, mut visit: impl FnMut(f64, f64, Option<&Cut>)) {
        // Seen from the query the border is, between these angles, either the rim or one cut.
        let mut angles = vec![0.0, TAU];
        let mut add = |angle: f64| angles.push(angle - (angle / TAU).floor() * TAU);
        for (i, a) in self.cuts.iter().enumerate() {
            let half = libm::acos(a.distance);
            add(a.angle - half);
            add(a.angle + half);
            for b in &self.cuts[i + 1..] {
                // Where a.distance / cos(x - a.angle) = b.distance / cos(x - b.angle), here and on the other side.
                let sine = b.distance * libm::cos(a.angle) - a.distance * libm::cos(b.angle);
                let cosine = a.distance * libm::sin(b.angle) - b.distance * libm::sin(a.angle);
                let corner = libm::atan2(sine, cosine);
                add(corner);
                add(corner + TAU / 2.0);
            }
        }
        angles.sort_unstable_by(f64::total_cmp);
        for pair in angles.windows(2) {
            let middle = f64::midpoint(pair[0], pair[1]);
            let reach = |cut: &Cut| cut.distance / libm::cos(middle - cut.angle);
            let reached = |cut: &&Cut| libm::cos(middle - cut.angle) > cut.distance;
            visit(pair[0], pair[1], self.cuts.iter().filter(reached).min_by(|a, b| reach(a).total_cmp(&reach(b))));
        }
    }
}

/// The part of [`Disc::integral`] between two angles between which the border does not change.
fn sector(kernel: Kernel, from: f64, to: f64, border: Option<&Cut>) -> f64 {
    match border {
        // The query lies on the cut itself: nothing is left in this direction.
        Some(cut) if cut.distance <= 1e-9 => 0.0,
        Some(cut) => {
            let up_to = |angle: f64| kernel.triangle(cut.distance, libm::tan(angle - cut.angle));
            up_to(to) - up_to(from)
        }
        None => kernel.spoke() * (to - from),
    }
}

impl Stranger {
    /// Is it nearer than another, or as near and its id less?
    #[inline]
    fn is_nearer(&self, other: &Self) -> bool {
        self.rank.0.total_cmp(&other.rank.0).then(self.rank.1.cmp(&other.rank.1)).is_lt()
    }
}

impl Cut {
    /// How far a point (relative to the query, in radii) is on the query's side of the plane; negative beyond it.
    #[inline]
    fn depth(&self, offset: DVec3) -> f64 {
        self.normal.dot(offset) + self.height
    }
}

#[cfg(test)]
mod tests;
