//! A trace of ours for another simulator.

use super::Args;
use crate::cli::{Progress, create_output, named, open_input, refuse_part, usage};
use anyhow::Context as _;
use pm_exchange::traces::{Exporter, TraceExport};
use pm_formats::trace::TraceReader;
use std::path::Path;

/// Writes the one trace there is in this format.
pub(super) fn export(format: &'static dyn TraceExport, args: &Args) -> anyhow::Result<()> {
    let [path] = &args.streams[..] else {
        return Err(usage("--export reads one trace"));
    };
    let line = args.line.map(|line| line.0);
    if line.is_some_and(|line| !line.is_power_of_two() || line > 1 << 31) {
        return Err(usage("--line: a power of two up to 2147483648 is needed"));
    }
    let name = named(path);
    let mut trace = TraceReader::from_blocks(open_input(path)?).context(name.clone())?;
    refuse_part(&name, trace.header(), "other formats do not say so")?;
    let regions = trace.header().regions.clone();
    let output = match format.is_text() {
        true => create_output(args.output.output.as_deref().unwrap_or(Path::new("-")))?,
        false => args.output.create()?,
    };
    let mut exporter = Exporter::new(format, line, &regions, output)?;
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(&mut exporter).with_context(|| name.clone())? {
        exporter.check().with_context(|| name.clone())?;
        progress.add(block.records.into());
    }
    exporter.finish()?.commit()
}
