//! Queries as they came, kept until it is known what becomes of them: in memory, and beyond it in a temporary file.

use super::runs::Runs;
use super::sorted::no_memory;
use pm_formats::Query;
use std::path::PathBuf;

/// Queries in the order in which they came.
pub(super) struct Arrivals {
    held: Vec<Query>,
    most: usize,
    runs: Runs,
}

impl Arrivals {
    /// None yet. They may take so many bytes of memory; beyond, they lie in `folder`.
    pub(super) fn new(folder: PathBuf, memory: u64) -> Self {
        let most = (memory / size_of::<Query>() as u64).clamp(1, 1 << 32) as usize;
        Self { held: vec![], most, runs: Runs::new(folder, memory) }
    }

    /// Would these not fit the memory?
    pub(super) const fn overflows(&self, queries: usize) -> bool {
        self.held.len() + queries > self.most
    }

    /// These came.
    ///
    /// # Errors
    /// Those of temporary files, and if the system has less memory than was allowed.
    pub(super) fn push(&mut self, queries: &[Query]) -> pm_formats::Result<()> {
        if self.overflows(queries.len()) && !self.held.is_empty() {
            self.spill()?;
        }
        self.held.try_reserve(queries.len()).map_err(|_| no_memory())?;
        self.held.extend_from_slice(queries);
        Ok(())
    }

    /// Moves them to the disk: of one key, so that they come back as they came.
    fn spill(&mut self) -> pm_formats::Result<()> {
        self.runs.add(self.held.drain(..).map(|query| (0, query)))?;
        Ok(())
    }

    /// All of them; none is left.
    ///
    /// # Errors
    /// Those of temporary files, and of `each`.
    pub(super) fn drain(&mut self, mut each: impl FnMut(&[Query]) -> pm_formats::Result<()>) -> pm_formats::Result<()> {
        if self.runs.is_empty() {
            each(&self.held)?;
            self.held.clear();
            return Ok(());
        }
        self.spill()?;
        self.runs.drain(|_, query| each(&[query]))
    }
}
