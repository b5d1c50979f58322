//! Which part of the photons' disc lies on the query's own surface.
//!
//! Near an edge the disc reaches beyond the surface. Photons of the surface round the corner, which the estimate leaves
//! out, show where: the plane of each cuts the disc. What lies beyond a cut is left out of the area *and* of the sum, so
//! wherever the cuts are the estimate is unbiased on an even density; a cut in the wrong place only wastes photons.
//!
//! The problem is the boundary bias of Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 7.2, who
//! leaves it; convex hulls of the photons found are the usual cure, but shrink the area everywhere.

mod slope;

pub(super) use slope::Slope;

use super::kernel::Kernel;
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

    /// Cuts the disc where the surfaces of `strangers` (in any order) meet it: nearest first, each unless it lies beyond
    /// the cuts before it.
    pub(super) fn cut(&mut self, strangers: &[Stranger]) {
        self.cut_up_to(MOST_CUTS, strangers);
    }

    /// The same with this many cuts at most.
    pub(super) fn cut_up_to(&mut self, most: usize, strangers: &[Stranger]) {
        while self.cuts.len() < most {
            let mut nearest: Option<((f32, u32), Cut)> = None;
            for stranger in strangers {
                let is_nearer = |((distance, id), _): ((f32, u32), Cut)| {
                    stranger.rank.0.total_cmp(&distance).then(stranger.rank.1.cmp(&id)).is_lt()
                };
                if nearest.is_none_or(is_nearer)
                    && self.cuts.iter().all(|cut| cut.depth(stranger.offset) > ON_THE_PLANE)
                    && let Some(cut) = self.cut_by(stranger)
                {
                    nearest = Some((stranger.rank, cut));
                }
            }
            match nearest {
                Some((_, cut)) => self.cuts.push(cut),
                None => break,
            }
        }
    }

    /// The cut that a photon's plane makes, if it reaches the disc.
    fn cut_by(&self, stranger: &Stranger) -> Option<Cut> {
        let height = -stranger.normal.dot(stranger.offset);
        // At a convex edge the query is behind the other surface: the plane is the same.
        let (normal, height) = if height < 0.0 { (-stranger.normal, -height) } else { (stranger.normal, height) };
        let along = normal - self.normal * normal.dot(self.normal);
        let sine = along.length();
        if sine < LEAST_SINE || height >= sine {
            return None;
        }
        let towards = along / -sine;
        let angle = self.cuts.first().map_or(0.0, |first| {
            libm::atan2(self.normal.dot(first.towards.cross(towards)), first.towards.dot(towards))
        });
        Some(Cut { normal, height, distance: height / sine, angle, towards })
    }

    /// Is a point (relative to the query, in radii) on the query's side of every cut?
    #[inline]
    pub(super) fn holds(&self, offset: DVec3) -> bool {
        self.cuts.iter().all(|cut| cut.depth(offset) >= 0.0)
    }

    /// The planes that cut it: unit normal towards the middle, and the middle's distance from the plane in radii.
    pub(super) fn planes(&self) -> impl Iterator<Item = (DVec3, f64)> {
        self.cuts.iter().map(|cut| (cut.normal, cut.height))
    }

    /// Is it the whole disc?
    #[inline]
    pub(super) const fn is_whole(&self) -> bool {
        self.cuts.is_empty()
    }

    /// How far the query is from the nearest plane that cuts the disc, in radii; if none does, as far as a plane would surely
    /// be shown by some photons. So far all around it is as here.
    pub(super) fn reach(&self) -> f64 {
        self.cuts.iter().map(|cut| cut.height).fold(SURELY_SEEN, f64::min)
    }

    /// Integral of the kernel's weight over the disc, in squared radii: its area, for the constant kernel.
    pub(super) fn integral(&self, kernel: Kernel) -> f64 {
        if self.is_whole() {
            return kernel.disc();
        }
        let mut sum = 0.0;
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

impl Cut {
    /// How far a point is on the query's side of the plane; negative beyond it.
    #[inline]
    fn depth(&self, offset: DVec3) -> f64 {
        self.normal.dot(offset) + self.height
    }
}

#[cfg(test)]
mod tests;
