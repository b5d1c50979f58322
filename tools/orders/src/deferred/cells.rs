//! Cell by cell, of cells so large that the photons of each just fit a cache.

use super::leaf::by_cell;
use super::parameters::{LEAF_PHOTONS, PHOTONS};
use crate::{Charge, Order, Reorder, Setting, Store};
use pm_registry::{ParameterError, Values};

pm_registry::registered! {
    /// By cells that each hold so many photons that they fit the cache, and as they came within a cell
    pub struct Cells = "cells" with [PHOTONS.needed(), LEAF_PHOTONS.or("2048")];
}

impl Order for Cells {
    fn label(&self, values: &Values, _: Store) -> String {
        format!("cells of {}", values.count::<u32>(LEAF_PHOTONS.name))
    }

    fn forms(&self) -> &'static [&'static str] {
        &["--photons map.pmp --leaf-photons 100", "--photons map.pmp"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        Ok(by_cell(setting, Charge::Cells))
    }
}
