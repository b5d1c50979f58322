//! Sorting more queries than memory holds: sorted runs in temporary files, merged when all are there.
//!
//! The files have no name from the moment they exist, so that they are gone whatever becomes of the program.

mod file;
mod merge;

use file::{Keyed, Run, Writer, explained};
use merge::merge;
use pm_formats::Query;
use std::fs::File;
use std::io;
use std::path::PathBuf;

/// Most runs of a level: so many files are open at once, and then they are merged into one.
const FAN: usize = 128;
/// Bytes that are read or written at a time, at least.
const LEAST_BUFFER: u64 = 4096;

/// Sorted runs on disk, those of earlier queries first.
pub(super) struct Runs {
    folder: PathBuf,
    runs: Vec<Run>,
    /// Bytes of memory for buffers.
    memory: u64,
}

impl Runs {
    /// No runs yet; they will lie in `folder`.
    pub(super) const fn new(folder: PathBuf, memory: u64) -> Self {
        Self { folder, runs: vec![], memory }
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Writes a run, sorted by key. Runs are given in the order in which their queries came.
    pub(super) fn add(&mut self, sorted: impl Iterator<Item = (u32, Query)>) -> io::Result<()> {
        let mut writer = Writer::new(self.create()?, &self.folder);
        for (key, query) in sorted {
            writer.push(Keyed { key, query })?;
        }
        self.runs.push(writer.finish(0)?);
        while let Some(level) = self.full_level() {
            let rest = self.runs.split_off(self.runs.len() - FAN);
            let mut writer = Writer::new(self.create()?, &self.folder);
            merge(rest, self.buffer(FAN), &self.folder, |keyed| writer.push(keyed))?;
            self.runs.push(writer.finish(level + 1)?);
        }
        Ok(())
    }

    /// The level of the last runs if there are as many as may be.
    fn full_level(&self) -> Option<u32> {
        let first = self.runs.len().checked_sub(FAN)?;
        let level = self.runs[first].level;
        self.runs[first..].iter().all(|run| run.level == level).then_some(level)
    }

    /// All queries by key, equal keys in the order in which they came. No run is left.
    pub(super) fn drain(
        &mut self,
        mut each: impl FnMut(u32, Query) -> pm_formats::Result<()>,
    ) -> pm_formats::Result<()> {
        let runs = std::mem::take(&mut self.runs);
        let buffer = self.buffer(runs.len());
        // `merge` may fail by reading, `each` in its own way.
        let mut outcome = Ok(());
        let merged = merge(runs, buffer, &self.folder, |keyed| {
            outcome = each(keyed.key, keyed.query);
            outcome.as_ref().map(|_| ()).map_err(|_| io::ErrorKind::Other.into())
        });
        outcome.and(merged.map_err(Into::into))
    }

    /// Records in the buffer of each of so many runs.
    fn buffer(&self, runs: usize) -> usize {
        let bytes = (self.memory / (runs.max(1) as u64)).clamp(LEAST_BUFFER, 1 << 20);
        bytes as usize / size_of::<Keyed>()
    }

    fn create(&self) -> io::Result<File> {
        tempfile::tempfile_in(&self.folder).map_err(|error| explained("make", &self.folder, error))
    }
}

#[cfg(test)]
mod tests;
