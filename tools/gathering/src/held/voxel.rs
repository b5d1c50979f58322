//! A voxel: 16 bytes that say what is known of the piece of surface in a small cube.

use super::{Sample, patch};
use crate::surface::{coarse, on_same_surface};
use pm_formats::{pack_direction, pack_rgbe, unpack_direction, unpack_rgbe};
use pm_random::Random;

/// What the random numbers that round irradiance are for: its own word, so that they are no others'.
const ROUNDING: u64 = 0x766f_7865_6c00_0000;
/// Points and samples farther than this share of the width from the mean plane are of another surface.
const FARTHEST_FROM_PLANE: f64 = 1.0 / 8.0;
/// Steps in which heights are told, to either side.
const HEIGHT_STEPS: f64 = 127.0;
/// Columns along each of two axes into which a cube is cut, across its surface.
const COLUMNS: u32 = 8;
/// More samples than this are of more than one voxel can tell: their reach is small beside it.
const MOST_SAMPLES: usize = 1024;

/// What is known of the surface in a cube. Nothing, where there is no sample, or where samples are of several surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub(super) struct Voxel {
    /// The columns of the cube in which it counts, a bit each; none if nothing is known.
    known: u64,
    /// Mean over the surface, in watts per square scene unit, RGBE.
    irradiance: [u8; 4],
    /// Octahedral, 7 bits a coordinate.
    normal: u16,
    /// Of the mean plane above the centre, along the normal, in [`HEIGHT_STEPS`] of the width.
    height: i8,
    spare: u8,
}

const _: () = assert!(size_of::<Voxel>() == 16);

/// A cube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    pub(super) centre: [f64; 3],
    pub(super) width: f64,
}

impl Cell {
    fn offset(&self, point: [f32; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| f64::from(point[axis]) - self.centre[axis])
    }
}

/// A plane through a cell, by which its columns are told: they run along the axis that the plane faces most.
struct Plane {
    cell: Cell,
    /// Unit normal.
    normal: [f32; 3],
    /// Above the cell's centre, along the normal.
    height: f64,
    /// The axis that it faces, and the two others.
    axes: [usize; 3],
}

impl Plane {
    fn new(cell: Cell, normal: [f32; 3], height: f64) -> Self {
        let faced = longest(normal);
        Self { cell, normal, height, axes: [faced, (faced + 1) % 3, (faced + 2) % 3] }
    }

    /// Height of a point above it.
    fn above(&self, point: [f32; 3]) -> f64 {
        dot(self.cell.offset(point), self.normal) - self.height
    }

    /// Number of the column in which a point is; `None` outside the cell.
    fn column(&self, point: [f32; 3]) -> Option<u32> {
        let offset = self.cell.offset(point);
        let along = |axis: usize| (offset[axis] / self.cell.width + 0.5) * f64::from(COLUMNS);
        let [u, v] = [self.axes[1], self.axes[2]].map(along);
        // Points in a cell may lie on its rim, by the rounding of its coordinates.
        let inside = |x: f64| (-1e-6..=f64::from(COLUMNS) + 1e-6).contains(&x);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the columns")]
        let whole = |x: f64| (x.max(0.0) as u32).min(COLUMNS - 1);
        (inside(u) && inside(v)).then(|| whole(u) + COLUMNS * whole(v))
    }

    /// Where a column meets it, from the cell's centre; and how far the piece within the column goes from there.
    fn piece(&self, column: u32) -> ([f64; 3], f64) {
        let [faced, u, v] = self.axes;
        let at = |x: u32| ((f64::from(x) + 0.5) / f64::from(COLUMNS) - 0.5) * self.cell.width;
        let mut offset = [0.0; 3];
        (offset[u], offset[v]) = (at(column % COLUMNS), at(column / COLUMNS));
        let slant = f64::from(self.normal[faced]);
        offset[faced] = (self.height - dot(offset, self.normal)) / slant;
        (offset, self.cell.width / f64::from(COLUMNS) * 0.5f64.sqrt() / slant.abs())
    }
}

/// The axis along which a vector is longest, the first of equals.
pub(super) fn longest(vector: [f32; 3]) -> usize {
    (1..3).fold(0, |longest, axis| if vector[axis].abs() > vector[longest].abs() { axis } else { longest })
}

fn dot(a: [f64; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|axis| a[axis] * f64::from(b[axis])).sum()
}

fn length(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl Voxel {
    /// Of the samples in a cell; `name` tells it from others. It knows something where their normals are alike and they lie near one
    /// plane; of samples that do not reach one another it takes those that hang together and are most, and it counts in the
    /// columns that one of these reaches as a whole. So neither light from behind a wall nor a shadow goes through.
    ///
    /// Samples are photons, which lie denser where there is more light. So each weighs by the area that one photon stands for,
    /// which is the inverse of irradiance; without that bright parts of a cell would count twice.
    pub(super) fn of(samples: &[&Sample], cell: Cell, name: u64) -> Self {
        let Some((plane, code, height)) = plane(samples, cell) else { return Self::default() };
        let samples = patch::largest(samples);
        let columns = (0..COLUMNS * COLUMNS).filter(|&column| {
            let (at, size) = plane.piece(column);
            samples.iter().any(|sample| {
                let offset = cell.offset(sample.position);
                length([0, 1, 2].map(|axis| offset[axis] - at[axis])) + size <= f64::from(sample.reach)
            })
        });
        let known = columns.fold(0, |known, column| known | 1 << column);
        let irradiance = mean_irradiance(&samples, name);
        irradiance.map_or(Self::default(), |irradiance| Self { known, irradiance, normal: code, height, spare: 0 })
    }

    /// Is anything known?
    pub(super) const fn is_known(&self) -> bool {
        self.known != 0
    }

    /// Irradiance at a point of this unit normal, if the voxel of this cell knows of its surface.
    pub(super) fn at(&self, point: [f32; 3], normal: [f32; 3], cell: Cell) -> Option<[f64; 3]> {
        if !self.is_known() {
            return None;
        }
        let own = unpack_direction::<7>(u32::from(self.normal));
        let plane = Plane::new(cell, own, f64::from(self.height) / HEIGHT_STEPS * cell.width);
        let knows = plane.column(point).is_some_and(|column| self.known >> column & 1 == 1)
            && plane.above(point).abs() <= FARTHEST_FROM_PLANE * cell.width
            && on_same_surface(coarse(own), normal);
        knows.then(|| unpack_rgbe(self.irradiance))
    }
}

/// The plane near which all samples lie, the code of its normal and that of its height; `None` if they do not agree.
#[expect(clippy::cast_possible_truncation, reason = "14 bits; clamped; a normal's components")]
fn plane(samples: &[&Sample], cell: Cell) -> Option<(Plane, u16, i8)> {
    let along = [0, 1, 2].map(|axis| samples.iter().map(|sample| f64::from(sample.normal[axis])).sum::<f64>());
    let long = length(along);
    if samples.is_empty() || samples.len() > MOST_SAMPLES || long <= 0.0 {
        return None;
    }
    // As everybody will read it, so that what is checked here is what counts there.
    let code = pack_direction::<7>(along.map(|x| (x / long) as f32));
    let normal = unpack_direction::<7>(code);
    let heights = samples.iter().map(|sample| dot(cell.offset(sample.position), normal));
    let height = heights.sum::<f64>() / samples.len() as f64 / cell.width * HEIGHT_STEPS;
    let height = height.round().clamp(-HEIGHT_STEPS, HEIGHT_STEPS);
    let plane = Plane::new(cell, normal, height / HEIGHT_STEPS * cell.width);
    let agrees = |sample: &&Sample| {
        on_same_surface(coarse(sample.normal), normal)
            && plane.above(sample.position).abs() <= FARTHEST_FROM_PLANE * cell.width
    };
    samples.iter().all(agrees).then_some((plane, code as u16, height as i8))
}

/// The mean over the area, as RGBE; `None` if nothing is known of it.
#[expect(clippy::cast_possible_truncation, reason = "RGBE takes single precision")]
fn mean_irradiance(samples: &[&Sample], name: u64) -> Option<[u8; 4]> {
    // A photon landed there; where its neighbours are all of other surfaces nothing is known of what fell there.
    let lit: Vec<_> = samples.iter().filter(|sample| sample.irradiance.iter().sum::<f64>() > 0.0).collect();
    let area = |sample: &Sample| 1.0 / sample.irradiance.iter().sum::<f64>();
    let all: f64 = lit.iter().map(|sample| area(sample)).sum();
    let of = |channel: usize| lit.iter().map(|sample| sample.irradiance[channel] * area(sample)).sum::<f64>() / all;
    let mut random = Random::new(&[ROUNDING, name]);
    let chances = [(); 3].map(|()| random.unit());
    if lit.is_empty() { None } else { pack_rgbe([0, 1, 2].map(|channel| of(channel) as f32), chances) }
}

#[cfg(test)]
mod tests;
