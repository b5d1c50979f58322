//! Sorting more queries than memory holds: sorted runs in temporary files, merged when all are there.
//!
//! The files have no name from the moment they exist, so that they are gone whatever becomes of the program.

use bytemuck::{Pod, Zeroable};
use pm_formats::{BLOCK_RECORDS, Query};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::PathBuf;

/// Most runs of a level: so many files are open at once, and then they are merged into one.
const FAN: usize = 128;
/// Bytes that are read or written at a time, at least.
const LEAST_BUFFER: u64 = 4096;

/// A query with its key, as the files hold them.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Keyed {
    key: u32,
    query: Query,
}

/// A sorted run in a file.
struct Run {
    file: File,
    records: u64,
    /// How many mergings it has been through.
    level: u32,
}

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

/// What could not be done with a temporary file, and what to do.
fn explained(what: &str, folder: &std::path::Path, error: io::Error) -> io::Error {
    let text = format!(
        "cannot {what} a temporary file in {}: {error}; set TMPDIR to a folder with room, or give more --memory",
        folder.display()
    );
    io::Error::new(error.kind(), text)
}

struct Writer<'a> {
    file: File,
    held: Vec<Keyed>,
    records: u64,
    folder: &'a std::path::Path,
}

impl<'a> Writer<'a> {
    fn new(file: File, folder: &'a std::path::Path) -> Self {
        Self { file, held: Vec::with_capacity(BLOCK_RECORDS), records: 0, folder }
    }

    fn push(&mut self, keyed: Keyed) -> io::Result<()> {
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

    fn finish(mut self, level: u32) -> io::Result<Run> {
        self.flush()?;
        Ok(Run { file: self.file, records: self.records, level })
    }
}

/// A run that is read, a buffer at a time.
struct Reader {
    file: File,
    left: u64,
    held: Vec<Keyed>,
    next: usize,
    most: usize,
}

impl Reader {
    fn new(run: Run, most: usize) -> io::Result<Self> {
        let mut file = run.file;
        file.seek(SeekFrom::Start(0))?;
        Ok(Self { file, left: run.records, held: vec![], next: 0, most })
    }

    fn next(&mut self) -> io::Result<Option<Keyed>> {
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

/// Merges runs; of equal keys those of earlier runs come first.
fn merge(
    runs: Vec<Run>,
    buffer: usize,
    folder: &std::path::Path,
    mut each: impl FnMut(Keyed) -> io::Result<()>,
) -> io::Result<()> {
    let reading = |error| explained("read", folder, error);
    let mut readers =
        runs.into_iter().map(|run| Reader::new(run, buffer)).collect::<io::Result<Vec<_>>>().map_err(reading)?;
    let mut heads: Vec<Option<Keyed>> = vec![];
    for reader in &mut readers {
        heads.push(reader.next().map_err(reading)?);
    }
    let mut least: BinaryHeap<Reverse<(u32, usize)>> =
        heads.iter().enumerate().filter_map(|(run, head)| head.map(|head| Reverse((head.key, run)))).collect();
    while let Some(Reverse((_, run))) = least.pop() {
        let keyed = heads[run].take().expect("a run in the heap has a head");
        each(keyed)?;
        heads[run] = readers[run].next().map_err(reading)?;
        least.extend(heads[run].map(|head| Reverse((head.key, run))));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::mix;

    fn query(pixel: u32) -> Query {
        Query { pixel, ..Query::zeroed() }
    }

    #[test]
    fn many_small_runs_come_back_sorted_and_stable() {
        // More than a level holds twice over, so that runs of two levels are merged.
        let mut runs = Runs::new(std::env::temp_dir(), 1 << 16);
        let all: Vec<(u32, Query)> = (0..3000u32).map(|i| ((mix(i.into()) % 50) as u32, query(i))).collect();
        for run in all.chunks(10) {
            let mut run = run.to_vec();
            run.sort_by_key(|&(key, _)| key);
            runs.add(run.into_iter()).unwrap();
        }
        assert!(runs.runs.len() < FAN);
        let mut expected = all;
        expected.sort_by_key(|&(key, _)| key);
        let mut got = vec![];
        runs.drain(|key, query| {
            got.push((key, query));
            Ok(())
        })
        .unwrap();
        assert!(got == expected);
        assert!(runs.is_empty());
    }

    #[test]
    fn where_no_file_can_be_the_message_says_what_to_do() {
        let mut runs = Runs::new("/nosuch/folder".into(), 1 << 16);
        let message = runs.add([(0, query(0))].into_iter()).unwrap_err().to_string();
        assert!(message.starts_with("cannot make a temporary file in /nosuch/folder: "), "{message}");
        assert!(message.ends_with("set TMPDIR to a folder with room, or give more --memory"), "{message}");
    }

    #[test]
    fn an_error_of_the_receiver_is_its_own() {
        let mut runs = Runs::new(std::env::temp_dir(), 1 << 16);
        runs.add([(0, query(0)), (1, query(1))].into_iter()).unwrap();
        let outcome = runs.drain(|_, _| Err(pm_formats::Error::Invalid("enough".into())));
        assert_eq!(outcome.unwrap_err().to_string(), "cannot be written to a stream: enough");
    }
}
