//! Merging of sorted runs.

use super::file::{Keyed, Reader, Run, explained};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::io;
use std::path::Path;

/// Merges runs; of equal keys those of earlier runs come first.
pub(super) fn merge(
    runs: Vec<Run>,
    buffer: usize,
    folder: &Path,
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
