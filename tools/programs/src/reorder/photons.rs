//! The photons by whose cells an order goes.

use super::args::Args;
use crate::cli::{named, open_input, usage};
use anyhow::Context as _;
use pm_formats::{Photon, RecordReader, Step};
use std::path::Path;

/// A photon map, as far as cells need it.
pub(super) struct Photons {
    /// The name of its file, as it was typed.
    pub(super) name: String,
    pub(super) history: Vec<Step>,
    pub(super) positions: Vec<[f32; 3]>,
}

impl Photons {
    /// Reads the file that the order was given, if it was given one.
    pub(super) fn read(args: &Args) -> anyhow::Result<Option<Self>> {
        let Some(path) = args.order.values.file().map(Path::new) else { return Ok(None) };
        if path == Path::new("-") && args.first.queries == Path::new("-") {
            return Err(usage("standard input (`-`) can be read only once: name the photons or the queries by file"));
        }
        let name = named(path);
        let mut reader = RecordReader::<Photon, _>::from_blocks(open_input(path)?).context(name.clone())?;
        let mut positions = vec![];
        while let Some((_, photons)) = reader.next_block().with_context(|| name.clone())? {
            positions.extend(photons.iter().map(|photon| photon.position));
        }
        let history = reader.header().history.clone();
        Ok(Some(Self { name: path.display().to_string(), history, positions }))
    }
}
