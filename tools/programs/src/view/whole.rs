//! A stream read to its end, and its end block as text.

use crate::cli::Progress;
use indicatif::{BinaryBytes, HumanCount};
use pm_formats::trace::{Access, TraceReader, TraceSink};
use pm_formats::{BlockReader, End, Number, Photon, Query, Record, RecordReader, StreamKind, UnroundedPhoton};
use std::io::{self, Read, Write};

/// A stream that was read to its end block and is whole.
pub(super) struct Whole {
    /// The end block.
    pub(super) end: End,
    /// Number of batches.
    pub(super) batches: u64,
    /// Number of blocks.
    pub(super) blocks: u64,
    /// Accesses, in a trace.
    pub(super) accesses: Option<u64>,
}

/// Reads a stream to its end and checks all of it.
pub(super) fn read_to_end<R: Read>(stream: BlockReader<R>, quiet: bool) -> pm_formats::Result<Whole> {
    let progress = Progress::new(stream.header().expected_records, "records", quiet);
    let (mut batches, mut blocks, mut last_batch) = (0, 0, None);
    let mut block = |batch: u64, records: u64| {
        batches += u64::from(last_batch != Some(batch));
        last_batch = Some(batch);
        blocks += 1;
        progress.add(records);
    };
    let mut counter = Counter(0);
    let (end, accesses) = match stream.kind() {
        StreamKind::Photons => (records::<Photon, _>(stream, block)?, None),
        StreamKind::Queries => (records::<Query, _>(stream, block)?, None),
        StreamKind::UnroundedPhotons => (records::<UnroundedPhoton, _>(stream, block)?, None),
        StreamKind::Trace => {
            let mut reader = TraceReader::from_blocks(stream)?;
            while let Some(meta) = reader.replay_block(&mut counter)? {
                block(meta.batch, meta.records.into());
            }
            (reader.end()?.clone(), Some(counter.0))
        }
    };
    Ok(Whole { end, batches, blocks, accesses })
}

/// Reads records to their end block, and tells of each block its batch and their number.
fn records<T: Record, R: Read>(stream: BlockReader<R>, mut block: impl FnMut(u64, u64)) -> pm_formats::Result<End> {
    let mut reader = RecordReader::<T, _>::from_blocks(stream)?;
    while let Some((meta, records)) = reader.next_block()? {
        block(meta.batch, records.len() as u64);
    }
    reader.end().cloned()
}

struct Counter(u64);

impl TraceSink for Counter {
    fn access(&mut self, _: Access) {
        self.0 += 1;
    }
}

/// Writes what an end block says.
pub(super) fn end(whole: &Whole, output: &mut impl Write) -> io::Result<()> {
    let Whole { end, batches, blocks, accesses } = whole;
    let mut line = |name: &str, value: String| writeln!(output, "{name:<12} {value}");
    let count = |n: u64| HumanCount(n).to_string();
    line("records", format!("{} in {} blocks, {} batches", count(end.tally.records), count(*blocks), count(*batches)))?;
    if let Some(accesses) = accesses {
        line("accesses", count(*accesses))?;
    }
    line("digest", end.tally.digest.to_string())?;
    for stage in &end.stages {
        for (name, number) in &stage.measures {
            let number = match number {
                Number::Count(n) => count(*n),
                Number::Bytes(n) => format!("{} ({n} bytes)", BinaryBytes(*n)),
                Number::Real(x) => x.to_string(),
            };
            line(&stage.program, format!("{name} {number}"))?;
        }
    }
    Ok(())
}
