//! The formats of traces there are: a line each.

use super::formats::{
    ChampSim, ChampSimCloudSuite, Csv, Din, Dinb, DrMemTrace, Dramsim3, Gem5, Lackey, Lcs, OracleGeneral, Pinatrace,
    Prospero, ProsperoBinary, Ramulator1, Ramulator2, RamulatorCpu, Raw32, Raw64, Spike, Stl, Xdin,
};
use super::{TraceExport, TraceImport};
use pm_registry::Registry;

/// Formats that are read.
#[must_use]
pub fn imports() -> Registry<dyn TraceImport> {
    Registry::new(
        "format of traces that is read",
        &[
            &Raw32,
            &Raw64,
            &Din,
            &Xdin,
            &Dinb,
            &Lackey,
            &Pinatrace,
            &DrMemTrace,
            &ChampSim,
            &ChampSimCloudSuite,
            &Spike,
            &Gem5,
            &OracleGeneral,
            &Lcs,
            &Csv,
            &Dramsim3,
            &Stl,
            &Prospero,
            &ProsperoBinary,
            &Ramulator1,
            &RamulatorCpu,
            &Ramulator2,
        ],
    )
}

/// Formats that are written.
#[must_use]
pub fn exports() -> Registry<dyn TraceExport> {
    Registry::new(
        "format of traces that is written",
        &[&Raw32, &Raw64, &Din, &Xdin, &Dinb, &Lackey, &OracleGeneral, &Csv, &Dramsim3, &Ramulator2],
    )
}
