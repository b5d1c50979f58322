//! What a map of cells is: irradiance by place, at several widths.

use pm_formats::Number;
use pm_formats::trace::Coding;
use pm_maps::SearchReads;

/// Where irradiance is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// In scene units.
    pub point: [f32; 3],
    /// Unit normal.
    pub normal: [f32; 3],
    /// Width that is looked at as one, in scene units.
    pub footprint: f32,
}

/// Cells of several widths, each with the mean irradiance of a piece of surface.
pub trait CellMap: Send + Sync {
    /// Its regions of a trace: name, bytes, bytes of a record, coding.
    fn regions(&self) -> Vec<(String, u64, u32, Coding)>;

    /// Irradiance at a place, in watts per square scene unit, by the widest cell that is not wider than the footprint and knows
    /// of the surface there; else a narrower one, else a wider one. The first of its regions has the number `first`.
    fn find(&self, place: &Place, first: u16, reads: &mut SearchReads) -> Option<[f64; 3]>;

    /// What building it has brought to light, by name.
    fn measures(&self) -> Vec<(&'static str, Number)>;
}
