//! Queries parted by the radius that they need, so that those of a part can all search with one.
//!
//! Zhu, *RTNN: Accelerating Neighbor Search Using Hardware Ray Tracing*, PPoPP 2022, parts queries so beside ordering them in space, each part
//! having a tree of boxes that are no larger than its radius. How far the k nearest reach is told beforehand by how large a box
//! with so many photons is. Within a part the queries stay as they came: parted behind an order, they have both.

use super::parameters::{LEAF_PHOTONS, PHOTONS};
use crate::{Charge, MedianSplit, Order, Reorder, Setting, Store};
use pm_formats::Query;
use pm_registry::{ParameterError, Values};

pm_registry::registered! {
    /// By the radius that they need, in octaves, told by the size of a cell with so many photons, and as they came within one
    pub struct Radius = "radius" with [PHOTONS.needed(), LEAF_PHOTONS.or("100")];
}

impl Order for Radius {
    fn label(&self, values: &Values, _: Store) -> String {
        format!("radius of {}", values.count::<u32>(LEAF_PHOTONS.name))
    }

    fn forms(&self) -> &'static [&'static str] {
        &["--photons map.pmp", "--photons map.pmp --leaf-photons 3"]
    }

    fn build(&self, mut setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let photons = setting.photons.take().unwrap_or_default();
        let octaves = Octaves::new(photons, setting.values.count(LEAF_PHOTONS.name));
        let (charge, tables) = (Charge::Cells(octaves.parts().into()), octaves.bytes());
        let keys = move |queries: &[Query]| queries.iter().map(|query| octaves.part(query)).collect();
        Ok(setting.sort(Box::new(keys), charge, tables))
    }
}

/// Cells of a median split, and in which octave the size of each lies.
pub(super) struct Octaves {
    cells: MedianSplit,
    /// The part of each cell: its octave among those that there are, the narrowest first.
    parts: Vec<u8>,
    number: u32,
}

impl Octaves {
    /// Of cells of `most` photons at most.
    pub(super) fn new(photons: Vec<[f32; 3]>, most: usize) -> Self {
        let cells = MedianSplit::new(photons.clone(), most);
        let mut boxes = vec![([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]); cells.cells() as usize];
        for photon in photons {
            let (low, high) = &mut boxes[cells.cell(photon) as usize];
            for axis in 0..3 {
                low[axis] = low[axis].min(photon[axis]);
                high[axis] = high[axis].max(photon[axis]);
            }
        }
        let octaves: Vec<u8> =
            boxes.iter().map(|(low, high)| octave([0, 1, 2].map(|axis| high[axis] - low[axis]))).collect();
        let mut there = octaves.clone();
        there.sort_unstable();
        there.dedup();
        let number = there.len() as u32;
        let parts = octaves.iter().map(|octave| there.partition_point(|known| known < octave) as u8).collect();
        Self { cells, parts, number }
    }

    /// How many parts there are.
    pub(super) const fn parts(&self) -> u32 {
        self.number
    }

    /// The part that a query belongs to.
    pub(super) fn part(&self, query: &Query) -> u32 {
        self.parts[self.cells.cell(query.position) as usize].into()
    }

    /// Bytes on chip: the tree, and a byte for each cell.
    pub(super) fn bytes(&self) -> u64 {
        self.cells.bytes() + self.parts.len() as u64
    }
}

/// Octave of the diagonal of a box with these sides: one more for twice as long. 0 of a point.
fn octave(sides: [f32; 3]) -> u8 {
    // In double precision, where no square of single precision is too large or too small.
    let squared: f64 = sides.iter().map(|&side| f64::from(side).powi(2)).sum();
    if squared <= 0.0 {
        return 0;
    }
    // Twice as long is two steps of the exponent of the square. Of single precision there are octaves from -149 on; what lies
    // below -127 is one.
    let exponent = (squared.to_bits() >> 52) as i64 - 1023;
    (exponent.div_euclid(2) + 128).clamp(1, 255) as u8
}

#[cfg(test)]
mod tests;
