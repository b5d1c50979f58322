//! A trace written for keeping.

use super::Args;
use crate::cli::{Progress, named, open_input, usage};
use anyhow::Context as _;
use pm_formats::trace::{TraceReader, TraceWriter};

/// Writes the one trace there is in fewer bytes.
pub(super) fn archive(args: &Args) -> anyhow::Result<()> {
    let [path] = &args.streams[..] else {
        return Err(usage("--archive reads one trace"));
    };
    let name = named(path);
    let mut trace = TraceReader::from_blocks(open_input(path)?).with_context(|| name.clone())?;
    let mut output = TraceWriter::new(args.output.create()?, trace.header())?;
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some((block, tally)) = trace.next_archived().with_context(|| name.clone())? {
        output.write(&block, tally)?;
        progress.add(tally.records);
    }
    drop(progress);
    output.finish(trace.end()?.stages.clone())?.commit()
}
