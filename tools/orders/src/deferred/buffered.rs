//! Through buffers of variable size, one for each cell of the scene, that share a store.
//!
//! After Pharr, Kolb, Gershbein, Hanrahan, *Rendering Complex Scenes with Memory-Coherent Ray Tracing*, SIGGRAPH 1997
//! (benefit over cost), and Gieseke, Heinermann, Oancea, Igel, *Buffer k-d Trees*, ICML 2014 (a buffer for each leaf).
//! Aila and Karras, *Architecture Considerations for Tracing Incoherent Rays*, HPG 2010, found buffers of fixed size
//! wanting.

mod cell_buffers;

use super::parameters::{CELL, LEAF_PHOTONS, PHOTONS};
use crate::{MedianSplit, Order, Reorder, Setting, Store};
use cell_buffers::CellBuffers;
use pm_curves::Grid;
use pm_formats::Query;
use pm_registry::{Parameter, ParameterError, Values};
use pm_size::Bytes;

/// Cells along the scene's longest side, unless their size is said or there are photons.
const CELLS: u32 = 8;
/// Most cells: all of them are looked at when one is chosen.
const MOST_BUFFERS: u32 = 16384;

const SIDE: Parameter =
    Parameter { help: "side of its cells, in scene units [default: 1/8 of the scene's longest side]", ..CELL };

pm_registry::registered! {
    /// Through buffers of cells that share the store: when it is full, the best by benefit over cost leaves; streaming
    pub struct Buffered = "buffered" with [PHOTONS, LEAF_PHOTONS.or("1024"), SIDE];
}

impl Order for Buffered {
    fn label(&self, _: &Values, store: Store) -> String {
        format!("buffered {}", Bytes(store.bytes))
    }

    fn is_streaming(&self) -> bool {
        true
    }

    fn forms(&self) -> &'static [&'static str] {
        &["", "--photons map.pmp --leaf-photons 64"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let (values, store) = (setting.values, setting.store);
        let idle = |option: &str, because: &str| {
            Err(ParameterError::Unfit(format!("--{option} does nothing {because}: leave --{option} out")))
        };
        if let Some(photons) = setting.photons {
            if values.is_given(CELL.name) {
                return idle(CELL.name, "with --photons, whose leaves are the cells");
            }
            let cells = MedianSplit::new(photons, values.count(LEAF_PHOTONS.name));
            let (number, tables) = (few_enough(cells.cells().into(), LEAF_PHOTONS)?, cells.bytes());
            let cell = move |query: &Query| cells.cell(query.position);
            return Ok(Box::new(CellBuffers::new(cell, number, store, tables)));
        }
        if values.is_given(LEAF_PHOTONS.name) {
            return idle(LEAF_PHOTONS.name, "without --photons");
        }
        let grid = values.length_if_any(CELL.name).map(|side| Grid::of_side(&setting.bounds, side, 1 << 20));
        let grid = grid.unwrap_or_else(|| Grid::across(&setting.bounds, CELLS));
        let [across, down, _] = grid.cells();
        let number = few_enough(grid.cells().map(u64::from).iter().product(), CELL)?;
        let cell = move |query: &Query| {
            let [x, y, z] = grid.cell(query.position);
            (z * down + y) * across + x
        };
        Ok(Box::new(CellBuffers::new(cell, number, store, 0)))
    }
}

/// Few enough cells for buffers; else a larger value of this parameter would help.
fn few_enough(cells: u64, by: Parameter) -> Result<u32, ParameterError> {
    u32::try_from(cells).ok().filter(|&cells| cells <= MOST_BUFFERS).ok_or_else(|| {
        let by = by.name;
        ParameterError::Unfit(format!("buffered has at most {MOST_BUFFERS} cells, not {cells}: give a larger --{by}"))
    })
}
