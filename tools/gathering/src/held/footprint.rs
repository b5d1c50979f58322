//! How much of a surface a query looks at as one.

use pm_formats::vocabulary::meaning;
use pm_formats::{Bounds, Header, Query};
use pm_registry::{Domain, Parameter};
use std::f64::consts::PI;

/// Rays that graze more than this are taken for rays at this cosine.
const LEAST_COSINE: f32 = 1.0 / 16.0;

/// Width of what may answer.
pub const FOOTPRINT: Parameter = Parameter::new(
    "footprint",
    Domain::Length,
    "widest voxel or cell that may answer [default: by the gather ray's share of the hemisphere and the scene's mean chord]",
)
.with_details(
    "A query does not say how far its ray came. Without this it is taken to be the mean chord of the scene's box, 4 V / S, which is \
     its mean for cosine-distributed rays in an empty convex room; rays from near are taken for wider than they are. Queries that \
     come with no number of gather rays are answered by the narrowest.",
)
.hidden();

/// The width of what queries look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Footprint {
    /// The same for all, in scene units.
    Fixed(f32),
    /// The square root of the area that a ray's cone cuts out of a plane it meets head on, in scene units.
    Ray(f32),
}

impl Footprint {
    /// Of the queries of a stream. One of N cosine-distributed gather rays stands for a solid angle of 2 pi / N on average; the
    /// record does not hold how far it came, which is taken to be the mean chord of the scene's box. Where no number of rays is
    /// known, nothing is wide.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "single precision is plenty")]
    pub fn of_rays(queries: &Header) -> Self {
        let rays = queries.meaning(meaning::GATHERS).and_then(|rays| rays.parse::<u32>().ok()).filter(|&rays| rays > 0);
        Self::Ray(rays.map_or(0.0, |rays| (mean_chord(&queries.bounds) * (2.0 * PI / f64::from(rays)).sqrt()) as f32))
    }

    /// The width that a query looks at, in scene units: aslant, the side of a square as large as what its ray's cone cuts out.
    #[must_use]
    pub fn width(&self, query: &Query) -> f32 {
        match *self {
            Self::Fixed(width) => width,
            Self::Ray(width) => {
                let (view, normal) = (query.view(), query.normal());
                let cosine: f32 = (0..3).map(|axis| view[axis] * normal[axis]).sum();
                width / cosine.abs().max(LEAST_COSINE).sqrt()
            }
        }
    }
}

impl std::fmt::Display for Footprint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fixed(width) => write!(f, "at most {width} wide"),
            Self::Ray(width) => write!(f, "at most {width} wide, more aslant"),
        }
    }
}

/// Mean length of the chords of a box along cosine-distributed rays from its walls: 4 V / S, as for every convex body.
fn mean_chord(bounds: &Bounds) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| f64::from(bounds.max[axis]) - f64::from(bounds.min[axis]));
    let surface = 2.0 * (x * y + y * z + z * x);
    if surface > 0.0 { 4.0 * x * y * z / surface } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable as _;
    use pm_random::Random;

    #[test]
    fn the_mean_chord_of_a_box_is_that_of_rays_cast_in_it() {
        let size = [1.0, 2.0, 0.5];
        let bounds = Bounds { min: [-1.0, 0.0, 3.0], max: [0.0, 2.0, 3.5] };
        // From points spread evenly over its six walls, by the cosine.
        let mut random = Random::new(&[5]);
        let areas = [0, 1, 2].map(|axis| size[(axis + 1) % 3] * size[(axis + 2) % 3]);
        let (mut sum, mut weight) = (0.0, 0.0);
        for i in 0..300_000usize {
            let axis = i % 3;
            let mut at = size.map(|side| side * random.unit());
            at[axis] = 0.0;
            let (sine, turn) = (random.unit().sqrt(), 2.0 * std::f32::consts::PI * random.unit());
            let mut way = [0.0; 3];
            way[axis] = (1.0 - sine * sine).max(1e-12).sqrt();
            way[(axis + 1) % 3] = sine * turn.cos();
            way[(axis + 2) % 3] = sine * turn.sin();
            let until = |side: usize| match way[side] {
                w if w > 0.0 => (size[side] - at[side]) / w,
                w => -at[side] / w,
            };
            let chord = (0..3).map(until).filter(|t| *t > 0.0 && t.is_finite()).fold(f32::INFINITY, f32::min);
            sum += f64::from(chord * areas[axis]);
            weight += f64::from(areas[axis]);
        }
        let known = mean_chord(&bounds);
        assert!((sum / weight / known - 1.0).abs() < 0.01, "{} {known}", sum / weight);
        assert!(mean_chord(&Bounds { min: [0.0; 3], max: [1.0, 0.0, 1.0] }) == 0.0);
    }

    #[test]
    fn rays_are_as_wide_as_their_share_of_the_hemisphere_is_far_away() {
        let mut header = Header { bounds: Bounds { min: [0.0; 3], max: [3.0; 3] }, ..Header::empty() };
        let query = |cosine: f32| {
            let (normal, view) = Query::pack_vectors([0.0, 1.0, 0.0], [(1.0 - cosine * cosine).sqrt(), cosine, 0.0]);
            Query { normal, view, ..Query::zeroed() }
        };
        assert_eq!(Footprint::of_rays(&header).width(&query(1.0)), 0.0, "nothing is known of rays");
        header.set_meaning(meaning::GATHERS, "none: direct visualisation");
        assert_eq!(Footprint::of_rays(&header).width(&query(1.0)), 0.0);
        header.set_meaning(meaning::GATHERS, 8);
        let width = |cosine| Footprint::of_rays(&header).width(&query(cosine));
        // Eight such squares, at the mean chord of 2, have the area of the half sphere there.
        assert!((8.0 * width(1.0).powi(2) - 2.0 * std::f32::consts::PI * 4.0).abs() < 1e-3, "{}", width(1.0));
        // Aslant the area grows with the cosine's inverse, up to a limit.
        assert!((width(0.25) / width(1.0) - 2.0).abs() < 1e-3);
        assert!((width(0.001) / width(1.0) - 4.0).abs() < 1e-3);
        assert_eq!(Footprint::Fixed(0.5).width(&query(0.25)), 0.5);
    }
}
