//! Where a picture is likely to be noisiest: at the edges of lamps, seen straight or by mirrors and glass.
//!
//! One pixel in a thousand can have a fifth of a picture's squared error: half a lamp and half a wall, of which each eye ray sees
//! all or nothing. Of some hundred pixels chosen alike, none or two are such, and what they say is off by that. They are found
//! with one eye ray for each pixel, and chosen more often than others.

use crate::rays::Design;
use crate::task::Task;
use pm_light::transport::{GatherRays, PixelCaster, RayCounts};
use pm_orders::VisiblePoints;
use pm_pictures::REL_MSE_EPSILON;

/// How often each pixel shall be chosen, relative to others.
pub(crate) struct Preview {
    size: [u32; 2],
    /// Pixels of one side of a block; those of a block are alike.
    side: u32,
    /// By block, row by row.
    importance: Vec<f64>,
}

/// Blocks at most: a larger picture is looked at with fewer eye rays than pixels.
const MOST_BLOCKS: f64 = (1 << 16) as f64;
/// The share of choices that are made with no regard to edges.
const PLAIN: f64 = 0.7;
/// How much more often than others a pixel may be chosen.
const MOST: f64 = 20.0;

impl Preview {
    /// Looks at the whole picture.
    pub(crate) fn of(task: &Task<'_>) -> Self {
        let size = task.camera.size();
        let side = blocks_side(task.pixels());
        let seen = emitted(task, size, side);
        Self { size, side, importance: importance(&seen, size[0].div_ceil(side) as usize) }
    }

    /// A picture without edges.
    #[cfg(test)]
    pub(crate) fn plain(size: [u32; 2]) -> Self {
        Self { size, side: size[0].max(size[1]), importance: vec![1.0] }
    }

    /// Of a picture whose pixels are of this importance, row by row.
    #[cfg(test)]
    pub(crate) const fn given(size: [u32; 2], importance: Vec<f64>) -> Self {
        Self { size, side: 1, importance }
    }

    pub(crate) const fn size(&self) -> [u32; 2] {
        self.size
    }

    pub(crate) fn importance(&self, [x, y]: [u32; 2]) -> f64 {
        let across = self.size[0].div_ceil(self.side);
        self.importance[(y / self.side * across + x / self.side) as usize]
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the root of a number of pixels")]
fn blocks_side(pixels: f64) -> u32 {
    libm::ceil(libm::sqrt(pixels / MOST_BLOCKS)).max(1.0) as u32
}

/// What is emitted along one eye ray of each block.
fn emitted(task: &Task<'_>, [width, height]: [u32; 2], side: u32) -> Vec<[f64; 3]> {
    let rays = GatherRays::new(task.surfaces.clone(), task.camera, Design::seen(1, task.seed_of(15, 0)));
    let middle = |block: u32, pixels: u32| (block * side + side / 2).min(pixels - 1);
    let mut seen = vec![];
    for row in 0..height.div_ceil(side) {
        let mut caster = PixelCaster::new(&rays, None);
        for column in 0..width.div_ceil(side) {
            let pixel = [middle(column, width), middle(row, height)];
            let mut light = [0.0; 3];
            let add = |radiance: glam::Vec3| (0..3).for_each(|c| light[c] += f64::from(radiance[c]));
            caster.pixel(pixel, VisiblePoints::All, |_| {}, add, &mut RayCounts::default());
            seen.push(light);
        }
    }
    seen
}

/// How often blocks are chosen, by what their eye rays and those of their neighbours saw.
fn importance(seen: &[[f64; 3]], across: usize) -> Vec<f64> {
    let contrast = |a: &[f64; 3], b: &[f64; 3]| {
        let of_channel = |c: usize| {
            let (half, mean) = ((a[c] - b[c]) / 2.0, f64::midpoint(a[c], b[c]));
            half * half / (mean * mean + REL_MSE_EPSILON)
        };
        libm::sqrt((0..3).map(of_channel).sum::<f64>() / 3.0)
    };
    let mut edges = vec![0.0f64; seen.len()];
    for at in 0..seen.len() {
        let right = (at % across + 1 < across).then_some(at + 1);
        let below = Some(at + across).filter(|&below| below < seen.len());
        for other in [right, below].into_iter().flatten() {
            let found = contrast(&seen[at], &seen[other]);
            edges[at] = edges[at].max(found);
            edges[other] = edges[other].max(found);
        }
    }
    let mean = edges.iter().sum::<f64>() / edges.len().max(1) as f64;
    let share = |edge: f64| if mean > 0.0 { ((1.0 - PLAIN) * edge / mean).min(MOST) } else { 0.0 };
    edges.into_iter().map(|edge| PLAIN + share(edge)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edges_of_a_lamp_stand_out() {
        let mut seen = vec![[0.0; 3]; 64];
        for at in [18, 19, 26, 27] {
            seen[at] = [5.0, 4.0, 3.0];
        }
        let found = importance(&seen, 8);
        let edges: Vec<usize> = (0..64).filter(|&at| found[at] > 1.0).collect();
        assert_eq!(edges, [10, 11, 17, 18, 19, 20, 25, 26, 27, 28, 34, 35]);
        assert!(importance(&vec![[1.0; 3]; 64], 8).iter().all(|&q| (q - PLAIN).abs() < 1e-12));
    }
}
