//! What is asked of a stream.

use super::Args;
use super::header::header;
use super::whole::{end, read_to_end};
use crate::cli::Input;
use pm_formats::BlockReader;
use std::io::Write;

/// Writes what is asked of a stream: its history, whether it is whole, its records, or all there is to say of it.
pub(super) fn look(args: &Args, name: &str, stream: BlockReader<Input>, output: &mut impl Write) -> anyhow::Result<()> {
    if args.history {
        write!(output, "{}", pm_formats::as_commands(&stream.header().history))?;
    } else if args.check {
        let kind = stream.kind();
        let whole = read_to_end(stream, args.voice.quiet)?;
        let tally = whole.end.tally;
        writeln!(output, "{name}: whole, {} {}, digest {}", tally.records, kind.plural(), tally.digest)?;
    } else if let Some(limit) = args.records {
        pm_exchange::records(stream, limit, output)?;
    } else {
        if args.streams.len() > 1 {
            writeln!(output, "== {name}")?;
        }
        header(stream.kind(), stream.version(), stream.header(), output)?;
        end(&read_to_end(stream, args.voice.quiet)?, output)?;
    }
    Ok(())
}
