//! How much photons of a cut disc count by where they lie, so that a density that slopes across it is found as it is in the
//! middle.
//!
//! The middle of what is left of a cut disc is not where the query is: near an edge the mean over it is that of a place
//! farther inside, at the edge itself by 4/(3 pi) of the radius. Local linear regression has no such bias: Fan,
//! *Design-adaptive Nonparametric Regression*, JASA 87, 1992; Jones, *Simple Boundary Correction for Kernel Density
//! Estimation*, Statistics and Computing 3, 1993. In a whole disc both are the same.

use super::{Cut, Disc};
use crate::kernel::Kernel;
use glam::{DMat3, DVec3};
use std::f64::consts::FRAC_PI_4;

/// Weight of a photon: `middle + gradient . offset`, with the offset in radii. Its mean over the disc is 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope {
    middle: f64,
    gradient: DVec3,
}

/// Where the disc is a sliver far from the query, weights would be mostly noise: then photons count alike.
const LARGEST_MIDDLE: f64 = 8.0;

/// Nodes and weights of Gauss's rule of five points on [-1, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.0, 0.568_888_888_888_888_9),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

impl Slope {
    /// That of a disc with this kernel; `None` if photons are to count alike.
    pub(crate) fn of(disc: &Disc, kernel: Kernel) -> Option<Self> {
        let towards = disc.cuts.first()?.towards;
        let moments = moments(disc, kernel);
        // The first row of the inverse, of a symmetric matrix, times the area.
        let row = moments.inverse().x_axis * moments.x_axis.x;
        let is_sound = row.is_finite() && (0.0..LARGEST_MIDDLE).contains(&row.x);
        is_sound.then(|| Self { middle: row.x, gradient: towards * row.y + disc.normal.cross(towards) * row.z })
    }

    /// Weight of a photon there.
    #[inline]
    pub(crate) fn weight(&self, offset: DVec3) -> f64 {
        self.middle + self.gradient.dot(offset)
    }
}

/// Integrals over the disc of the kernel's weight times (1, x, y) times (1, x, y), with x towards the first cut.
fn moments(disc: &Disc, kernel: Kernel) -> DMat3 {
    let mut sum = DMat3::ZERO;
    disc.sectors(|from, to, border| {
        let pieces = ((to - from) / FRAC_PI_4).ceil();
        let half = (to - from) / pieces / 2.0;
        let mut middle = from + half;
        while middle < to {
            for (node, weight) in GAUSS {
                let angle = middle + half * node;
                let reach = |cut: &Cut| (cut.distance / libm::cos(angle - cut.angle)).clamp(0.0, 1.0);
                let [area, first, second] = kernel.radial_moments(border.map_or(1.0, reach)).map(|x| x * weight * half);
                let to = DVec3::new(0.0, libm::cos(angle), libm::sin(angle));
                sum += DMat3::from_cols(
                    DVec3::X * area + to * first,
                    DVec3::X * (first * to.y) + to * (second * to.y),
                    DVec3::X * (first * to.z) + to * (second * to.z),
                );
            }
            middle += 2.0 * half;
        }
    });
    sum
}
