//! Looks into streams: what they are about, where they came from, whether they are whole, what their records say.

use anyhow::Context as _;
use clap::Parser;
use pm_formats::BlockReader;
use pm_tools::cli::{self, Input, Typed, Voice, create_output, named, open_input};
use pm_tools::view;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Look into a stream of photons, queries or memory accesses.
///
/// Without options: header, history, and, read to the end, counts, digest and what each stage measured.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// Streams to look into; `-` is standard input
    #[arg(default_value = "-")]
    streams: Vec<PathBuf>,
    /// Print the commands that made the stream, as they could be typed again; reads the header only
    #[arg(long, group = "what")]
    history: bool,
    /// Read all of it and print a line if it is whole
    #[arg(long, group = "what")]
    check: bool,
    /// Print records as tab-separated text, the first N or all
    #[arg(long, value_name = "N", group = "what", num_args = 0..=1, require_equals = true, default_missing_value = "18446744073709551615")]
    records: Option<u64>,
    #[command(flatten)]
    voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-view map.pmp
  pm-queries | pm-reorder hilbert | pm-view --records=10
  pm-view --check out/*.pm?
  pm-view --history trace.pmt";

fn main() -> ExitCode {
    cli::main("pm-view", run)
}

fn run(args: Args, _: &Typed) -> anyhow::Result<()> {
    let mut output = create_output(Path::new("-"))?;
    for path in &args.streams {
        let name = named(path);
        let stream = open_input(path)?;
        look(&args, &name, stream, &mut output).with_context(|| name.clone())?;
    }
    output.commit()
}

fn look(args: &Args, name: &str, stream: BlockReader<Input>, output: &mut impl Write) -> anyhow::Result<()> {
    if args.history {
        write!(output, "{}", pm_formats::as_commands(&stream.header().history))?;
    } else if args.check {
        let kind = stream.kind();
        let whole = view::read_to_end(stream, args.voice.quiet)?;
        let tally = whole.end.tally;
        writeln!(output, "{name}: whole, {} {}, digest {}", tally.records, kind.plural(), tally.digest)?;
    } else if let Some(limit) = args.records {
        view::records(stream, limit, output)?;
    } else {
        if args.streams.len() > 1 {
            writeln!(output, "== {name}")?;
        }
        view::header(stream.kind(), stream.header(), output)?;
        view::end(&view::read_to_end(stream, args.voice.quiet)?, output)?;
    }
    Ok(())
}
