//! Sorted runs in files without a name.

use bytemuck::{Pod, Zeroable};
use pm_formats::{BLOCK_RECORDS, Query};
use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::Path;

/// A query with its key, as the files hold them.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Keyed {
    pub(super) key: u32,
    pub(super) query: Query,
}

/// A sorted run in a file.
pub(super) struct Run {
    pub(super) file: File,
    pub(super) records: u64,
    /// How many mergings it has been through.
    pub(super) level: u32,
}

/// What could not be done with a temporary file, and what to do.
pub(super) fn explained(what: &str, folder: &Path, error: io::Error) -> io::Error {
    let text = format!(
        "cannot {what} a temporary file in {}: {error}; set TMPDIR to a folder with room, or give more --memory",
        folder.display()
    );
    io::Error::new(error.kind(), text)
}

/// A run that is written, a block at a time.
pub(super) struct Writer<'a> {
    file: File,
    held: Vec<Keyed>,
    records: u64,
    folder: &'a Path,
}

impl<'a> Writer<'a> {
    pub(super) fn new(file: File, folder: &'a Path) -> Self {
        Self { file, held: Vec::with_capacity(BLOCK_RECORDS), records: 0, folder }
    }

    pub(super) fn push(&mut self, keyed: Keyed) -> io::Result<()> {
        self.held.push(keyed);
        if self.held.len() == BLOCK_RECORDS { self.flush() } else { Ok(()) }
    }

    fn flush(&mut self) -> io::Result<()> {
        let written = self.file.write_all(bytemuck::cast_slice(&self.held));
        written.map_err(|error| explained("write", self.folder, error))?;
        self.records += self.held.len() as u64;
        self.held.clear();
        Ok(())
    }

    pub(super) fn finish(mut self, level: u32) -> io::Result<Run> {
        self.flush()?;
        Ok(Run { file: self.file, records: self.records, level })
    }
}

/// A run that is read, a buffer at a time.
pub(super) struct Reader {
    file: File,
    left: u64,
    held: Vec<Keyed>,
    next: usize,
    most: usize,
}

impl Reader {
    pub(super) fn new(run: Run, most: usize) -> io::Result<Self> {
        let mut file = run.file;
        file.seek(SeekFrom::Start(0))?;
        Ok(Self { file, left: run.records, held: vec![], next: 0, most })
    }

    pub(super) fn next(&mut self) -> io::Result<Option<Keyed>> {
        if self.next == self.held.len() {
            let records = self.left.min(self.most as u64);
            self.held.resize(records as usize, Keyed::zeroed());
            self.file.read_exact(bytemuck::cast_slice_mut(&mut self.held))?;
            self.left -= records;
            self.next = 0;
        }
        self.next += 1;
        Ok(self.held.get(self.next - 1).copied())
    }
}
