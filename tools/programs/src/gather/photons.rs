//! The photons that a map is built from.

use crate::cli::{Whole, named, read_whole, usage};
use anyhow::{anyhow, bail};
use pm_formats::vocabulary::measure;
use pm_formats::{Error, Header, Number, Photon, Tally};
use std::io;
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
        let read = read_whole::<Photon>(path).map_err(|error| advised(path, error));
        let Whole { header, records, end, tally } = read?;
        let Some(Number::Count(emitted_paths)) = end.measure(measure::EMITTED_PATHS) else {
            let name = named(path);
            bail!("{name}: the end block does not say how many paths were emitted; was it made by pm-photons?");
        };
        Ok(Self { header, records, emitted_paths, tally })
    }
}

/// What may be done about photons that are not there, or that are something else.
fn advised(path: &Path, error: anyhow::Error) -> anyhow::Error {
    let name = named(path);
    if let Some(Error::WrongKind { found, .. }) = error.chain().find_map(|cause| cause.downcast_ref()) {
        return usage(format!(
            "{name}: the stream holds {found}, but photons are needed first: pm-gather PHOTONS QUERIES"
        ));
    }
    let is_missing = |cause: &io::Error| cause.kind() == io::ErrorKind::NotFound;
    if error.chain().any(|cause| cause.downcast_ref().is_some_and(is_missing)) {
        return anyhow!(
            "{name}: No such file or directory: make it by `pm-photons -o {name}`, or name the photons first"
        );
    }
    error
}
