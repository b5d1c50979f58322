//! Which part of the photons' disc lies on the query's own surface.
//!
//! Near an edge the disc reaches beyond the surface. Photons of the surface round the corner, which the estimate leaves
//! out, show where: the plane of each cuts the disc. What lies beyond a cut is left out of the area *and* of the sum, so
//! wherever the cuts are the estimate is unbiased on an even density; a cut in the wrong place only wastes photons.
//!
//! The problem is the boundary bias of Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 7.2, who
//! leaves it; convex hulls of the photons found are the usual cure, but shrink the area everywhere.

use super::kernel::Kernel;
use glam::DVec3;
use std::f64::consts::TAU;

/// A room has three walls in a corner, so two cuts; the rest is for what stands in it.
const MOST_CUTS: usize = 4;
/// A photon this many radii or less inside a cut lies on it: packed normals are some 2 degrees off.
const ON_THE_PLANE: f64 = 1.0 / 16.0;
/// Planes that meet the query's at a smaller angle (its sine) do not cut it: the backs of thin walls, above all.
const LEAST_SINE: f64 = 0.4;

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
        while self.cuts.len() < MOST_CUTS {
            let nearest = strangers
                .iter()
                .filter(|stranger| self.cuts.iter().all(|cut| cut.depth(stranger.offset) > ON_THE_PLANE))
                .filter_map(|stranger| Some((stranger.rank, self.cut_by(stranger)?)))
                .min_by(|((a, a_id), _), ((b, b_id), _)| a.total_cmp(b).then(a_id.cmp(b_id)));
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

    /// Is it the whole disc?
    #[inline]
    pub(super) const fn is_whole(&self) -> bool {
        self.cuts.is_empty()
    }

    /// Integral of the kernel's weight over the disc, in squared radii: its area, for the constant kernel.
    pub(super) fn integral(&self, kernel: Kernel) -> f64 {
        if self.is_whole() {
            return kernel.disc();
        }
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
        angles.windows(2).map(|pair| self.sector(kernel, pair[0], pair[1])).sum()
    }

    /// The part of [`integral`](Self::integral) between two angles between which the border does not change.
    fn sector(&self, kernel: Kernel, from: f64, to: f64) -> f64 {
        let middle = f64::midpoint(from, to);
        let reach = |cut: &Cut| cut.distance / libm::cos(middle - cut.angle);
        let reached = |cut: &&Cut| libm::cos(middle - cut.angle) > cut.distance;
        let border = self.cuts.iter().filter(reached).min_by(|a, b| reach(a).total_cmp(&reach(b)));
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
}

impl Cut {
    /// How far a point is on the query's side of the plane; negative beyond it.
    #[inline]
    fn depth(&self, offset: DVec3) -> f64 {
        self.normal.dot(offset) + self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;
    use std::f64::consts::PI;

    /// A disc in the plane y = 0, cut by vertical planes at these distances and angles (degrees).
    fn disc(cuts: &[(f64, f64)]) -> Disc {
        let mut disc = Disc::new(DVec3::Y);
        let strangers: Vec<_> = (0..)
            .zip(cuts)
            .map(|(id, &(distance, degrees))| {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let towards = DVec3::new(cos, 0.0, sin);
                // Not beyond the cuts before it.
                let aside = DVec3::new(-sin, 1.0, cos);
                let rank = (distance as f32, id);
                Stranger { rank, offset: towards * distance + aside * 0.2, normal: -towards }
            })
            .collect();
        disc.cut(&strangers);
        assert_eq!(disc.cuts.len(), cuts.len());
        disc
    }

    #[test]
    fn a_segment_has_the_area_of_a_segment() {
        for d in [0.0, 0.1, 0.5, 0.99] {
            let segment = f64::acos(d) - d * f64::sqrt(1.0 - d * d);
            let area = disc(&[(d, 77.0)]).integral(Kernel::Constant);
            assert!((area - (PI - segment)).abs() < 1e-9, "{d}: {area}");
        }
        // A quarter, and a square.
        assert!((disc(&[(0.0, 0.0), (0.0, 90.0)]).integral(Kernel::Constant) - PI / 4.0).abs() < 1e-9);
        let square: Vec<_> = [0.0, 90.0, 180.0, 270.0].map(|angle| (0.6, angle)).into();
        assert!((disc(&square).integral(Kernel::Constant) - 1.44).abs() < 1e-9);
    }

    #[test]
    fn integrals_are_those_of_random_points() {
        let cuts: [&[(f64, f64)]; 5] = [
            &[],
            &[(0.3, 10.0)],
            &[(0.3, 10.0), (0.4, 100.0)],
            &[(0.2, -50.0), (0.35, 30.0), (0.6, 170.0)],
            &[(0.1, 0.0), (0.2, 80.0), (0.3, 160.0), (0.4, 240.0)],
        ];
        for (cuts, kernel) in
            cuts.iter().flat_map(|cuts| [Kernel::Constant, Kernel::Cone, Kernel::Epanechnikov].map(|k| (cuts, k)))
        {
            let disc = disc(cuts);
            let mut random = Random::new(&[3]);
            let n = 200_000;
            let mut sum = 0.0;
            for _ in 0..n {
                let (x, z) = (f64::from(random.unit()) * 2.0 - 1.0, f64::from(random.unit()) * 2.0 - 1.0);
                let s = x.hypot(z);
                if s < 1.0 && disc.holds(DVec3::new(x, 0.0, z)) {
                    sum += 4.0 * kernel.weight(s) / f64::from(n);
                }
            }
            let integral = disc.integral(kernel);
            // Standard error at most 2 / sqrt(n) = 0.0045.
            assert!((integral - sum).abs() < 0.015, "{cuts:?} {kernel:?}: {integral} for {sum}");
        }
    }

    #[test]
    fn only_what_reaches_the_disc_from_another_side_cuts_it() {
        let cut = |offset: DVec3, normal: DVec3| {
            let mut disc = Disc::new(DVec3::Y);
            disc.cut(&[Stranger { rank: (0.0, 0), offset, normal }]);
            !disc.is_whole()
        };
        assert!(cut(DVec3::new(0.5, 0.3, 0.0), DVec3::NEG_X));
        // A convex edge: the other surface looks away.
        assert!(cut(DVec3::new(0.5, -0.3, 0.0), DVec3::X));
        // The back of a thin wall; a wall whose plane passes by.
        assert!(!cut(DVec3::new(0.5, -0.01, 0.0), DVec3::NEG_Y));
        assert!(!cut(DVec3::new(0.7, 0.7, 0.0), DVec3::new(-0.8, -0.6, 0.0)));
    }
}
