//! Header and end block as text.

use crate::cli::Progress;
use indicatif::{BinaryBytes, HumanCount};
use pm_formats::trace::{Access, Coding, TraceReader, TraceSink};
use pm_formats::{BlockReader, End, Header, Number, Photon, Query, RecordReader, StreamKind, as_commands};
use std::io::{self, Read, Write};

/// Writes what a header says.
///
/// # Errors
/// What `output` reports.
pub fn header(kind: StreamKind, header: &Header, output: &mut impl Write) -> io::Result<()> {
    let mut line = |name: &str, value: String| writeln!(output, "{name:<12} {value}");
    line("stream", format!("{}, format version {}", kind.plural(), pm_formats::FORMAT_VERSION))?;
    let corner = |p: [f32; 3]| format!("({}, {}, {})", p[0], p[1], p[2]);
    line("bounds", format!("{} to {}", corner(header.bounds.min), corner(header.bounds.max)))?;
    if header.pixels() > 0 {
        line("image", format!("{} x {} pixels", header.image[0], header.image[1]))?;
    }
    for (id, material) in header.materials.iter().enumerate() {
        let [r, g, b] = material.diffuse;
        let mut text = format!("{id} {}: diffuse {r} {g} {b}", material.name);
        if material.specular != [0.0; 3] {
            let [r, g, b] = material.specular;
            text += &format!(", specular {r} {g} {b}, exponent {}", material.exponent);
        }
        line("material", text)?;
    }
    for region in &header.regions {
        let coding = match region.coding {
            Coding::Records => String::new(),
            Coding::HeapWalk { nodes, reread } => {
                let twice = if reread { ", inner nodes read twice" } else { "" };
                format!(", a tree of {} nodes{twice}", HumanCount(nodes.into()))
            }
        };
        let place = format!("{:#x} to {:#x}", region.base, region.base + region.size);
        line("region", format!("{}: {place}, records of {} bytes{coding}", region.name, region.record_size))?;
    }
    for (name, value) in &header.meaning {
        line(name, value.clone())?;
    }
    if let Some(records) = header.expected_records {
        line("expected", format!("up to {} records", HumanCount(records)))?;
    }
    for command in as_commands(&header.history).lines() {
        line("history", command.to_owned())?;
    }
    if let Some(step) = header.history.last() {
        line("version", step.version.clone())?;
    }
    Ok(())
}

/// A stream that was read to its end block and is whole.
pub struct Whole {
    /// The end block.
    pub end: End,
    /// Number of batches.
    pub batches: u64,
    /// Number of blocks.
    pub blocks: u64,
    /// Accesses, in a trace.
    pub accesses: Option<u64>,
}

/// Reads a stream to its end and checks all of it.
///
/// # Errors
/// Whatever is wrong with it.
pub fn read_to_end<R: Read>(stream: BlockReader<R>, quiet: bool) -> pm_formats::Result<Whole> {
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
        StreamKind::Photons => {
            let mut reader = RecordReader::<Photon, _>::from_blocks(stream)?;
            while let Some((meta, records)) = reader.next_block()? {
                block(meta.batch, records.len() as u64);
            }
            (reader.end()?.clone(), None)
        }
        StreamKind::Queries => {
            let mut reader = RecordReader::<Query, _>::from_blocks(stream)?;
            while let Some((meta, records)) = reader.next_block()? {
                block(meta.batch, records.len() as u64);
            }
            (reader.end()?.clone(), None)
        }
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

struct Counter(u64);

impl TraceSink for Counter {
    fn access(&mut self, _: Access) {
        self.0 += 1;
    }
}

/// Writes what an end block says.
///
/// # Errors
/// What `output` reports.
pub fn end(whole: &Whole, output: &mut impl Write) -> io::Result<()> {
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
