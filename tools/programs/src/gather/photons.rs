//! The photons that a map is built from.

use crate::cli::{Whole, named, read_whole};
use anyhow::bail;
use pm_formats::vocabulary::measure;
use pm_formats::{Header, Number, Photon, Tally};
use std::path::Path;

/// A photon stream read as a whole.
pub(super) struct Photons {
    pub(super) header: Header,
    pub(super) records: Vec<Photon>,
    pub(super) emitted_paths: u64,
    pub(super) tally: Tally,
}

impl Photons {
    /// Reads it.
    pub(super) fn read(path: &Path) -> anyhow::Result<Self> {
        let Whole { header, records, end, tally } = read_whole::<Photon>(path)?;
        let Some(Number::Count(emitted_paths)) = end.measure(measure::EMITTED_PATHS) else {
            let name = named(path);
            bail!("{name}: the end block does not say how many paths were emitted; was it made by pm-photons?");
        };
        Ok(Self { header, records, emitted_paths, tally })
    }
}
