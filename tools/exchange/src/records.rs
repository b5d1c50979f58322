//! Records as tab-separated text, with a line of names.

use pm_formats::trace::{Access, AccessKind, Region, TraceReader, TraceSink};
use pm_formats::{BlockReader, Photon, Query, RecordReader, StreamKind, UnroundedPhoton};
use std::fmt::Write as _;
use std::io::{Read, Write};

/// Writes the first `limit` records of a stream (of a trace, searches), one a line. Reads to the end even so, and an
/// incomplete stream is an error after what could be written.
///
/// # Errors
/// Whatever is wrong with the stream, or what `output` reports.
pub fn records<R: Read>(stream: BlockReader<R>, limit: u64, output: &mut impl Write) -> anyhow::Result<()> {
    match stream.kind() {
        StreamKind::Photons => photons(RecordReader::from_blocks(stream)?, limit, output),
        StreamKind::UnroundedPhotons => unrounded(RecordReader::from_blocks(stream)?, limit, output),
        StreamKind::Queries => queries(RecordReader::from_blocks(stream)?, limit, output),
        StreamKind::Trace => searches(TraceReader::from_blocks(stream)?, limit, output),
    }
}

fn photons<R: Read>(mut stream: RecordReader<Photon, R>, limit: u64, output: &mut impl Write) -> anyhow::Result<()> {
    writeln!(output, "photon\tx\ty\tz\tpower_r\tpower_g\tpower_b\tfrom_x\tfrom_y\tfrom_z\tn_x\tn_y\tn_z")?;
    let mut left = limit;
    let mut id = 0u64;
    while let Some((_, photons)) = stream.next_block()? {
        for photon in photons.iter().take(usize::try_from(left).unwrap_or(usize::MAX)) {
            write!(output, "{id}")?;
            numbers(output, photon.position)?;
            numbers(output, photon.power())?;
            numbers(output, photon.towards_source())?;
            numbers(output, photon.normal())?;
            writeln!(output)?;
            id += 1;
        }
        left = limit.saturating_sub(id);
    }
    Ok(())
}

fn unrounded<R: Read>(
    mut stream: RecordReader<UnroundedPhoton, R>,
    limit: u64,
    output: &mut impl Write,
) -> anyhow::Result<()> {
    writeln!(output, "batch\tpath\tx\ty\tz\tpower_r\tpower_g\tpower_b")?;
    let mut left = limit;
    while let Some((meta, photons)) = stream.next_block()? {
        for photon in photons.iter().take(usize::try_from(left).unwrap_or(usize::MAX)) {
            write!(output, "{}\t{}", meta.batch, photon.path)?;
            numbers(output, photon.position)?;
            numbers(output, photon.power)?;
            writeln!(output)?;
        }
        left = left.saturating_sub(photons.len() as u64);
    }
    Ok(())
}

fn queries<R: Read>(mut stream: RecordReader<Query, R>, limit: u64, output: &mut impl Write) -> anyhow::Result<()> {
    let names = "x\ty\tz\tn_x\tn_y\tn_z\tview_x\tview_y\tview_z\tweight_r\tweight_g\tweight_b";
    writeln!(output, "batch\tpixel\tsample\tmaterial\t{names}")?;
    let mut left = limit;
    while let Some((meta, queries)) = stream.next_block()? {
        for query in queries.iter().take(usize::try_from(left).unwrap_or(usize::MAX)) {
            write!(output, "{}\t{}\t{}\t{}", meta.batch, query.pixel, query.sample, query.material)?;
            numbers(output, query.position)?;
            numbers(output, query.normal())?;
            numbers(output, query.view())?;
            numbers(output, query.weight)?;
            writeln!(output)?;
        }
        left = left.saturating_sub(queries.len() as u64);
    }
    Ok(())
}

fn searches<R: Read>(mut stream: TraceReader<R>, limit: u64, output: &mut impl Write) -> anyhow::Result<()> {
    writeln!(output, "search\tbatch\tkind\tregion\toffset\tlength\taddress")?;
    let regions = stream.header().regions.clone();
    let mut text = AccessText { regions: &regions, limit, search: 0, batch: 0, text: String::new() };
    while stream.replay_block(&mut text)?.is_some() {
        output.write_all(text.text.as_bytes())?;
        text.text.clear();
    }
    Ok(())
}

fn numbers<T: std::fmt::Display>(output: &mut impl Write, numbers: [T; 3]) -> std::io::Result<()> {
    let [x, y, z] = numbers;
    write!(output, "\t{x}\t{y}\t{z}")
}

/// Spells out the accesses of the first searches.
struct AccessText<'a> {
    regions: &'a [Region],
    limit: u64,
    /// Searches begun.
    search: u64,
    batch: u64,
    text: String,
}

impl TraceSink for AccessText<'_> {
    fn block(&mut self, batch: u64, _: bool) {
        self.batch = batch;
    }

    fn search(&mut self, destinations: &[u32]) {
        if self.search < self.limit {
            let pixels: Vec<_> = destinations.iter().map(u32::to_string).collect();
            let _ = writeln!(self.text, "{}\t{}\tpixels\t{}\t\t\t", self.search, self.batch, pixels.join(","));
        }
        self.search += 1;
    }

    fn access(&mut self, access: Access) {
        if self.search > self.limit {
            return;
        }
        let kind = match access.kind {
            AccessKind::Read => "read",
            AccessKind::Write => "write",
            AccessKind::ReadModifyWrite => "rmw",
        };
        let region = &self.regions[usize::from(access.region)];
        let (search, batch, Access { offset, len, .. }) = (self.search - 1, self.batch, access);
        let address = region.base + offset;
        let _ = writeln!(self.text, "{search}\t{batch}\t{kind}\t{}\t{offset}\t{len}\t{address:#x}", region.name);
    }
}
