//! Keeps a share of a stream of gather queries, so that no more is simulated than an answer needs.

use anyhow::Context as _;
use clap::{ArgGroup, Parser};
use pm_formats::{Number, Query, RecordReader, RecordWriter, StageReport};
use pm_tools::cli::{self, OutputArgs, Progress, Typed, Voice, named, open_input};
use pm_tools::random::Random;
use std::path::PathBuf;
use std::process::ExitCode;

/// Keep a share of the gather queries: whole batches of them, or single ones.
///
/// Take the sample after reordering. Orders by batch (scanlines, tiles) are sampled by --batches: one of every N batches in
/// a row, the seed decides which, so that the step does not fall in with the width of the picture. Orders of the whole
/// image are one batch; thin them by --queries. The end block tells the share; what the stages before measured is of the
/// whole stream. Tables of cached irradiance beside the queries are passed on whole.
#[derive(Parser)]
#[command(after_help = EXAMPLES, group = ArgGroup::new("what").required(true).args(["batches", "every"]))]
struct Args {
    /// Queries to read; `-` is standard input
    #[arg(default_value = "-")]
    input: PathBuf,
    /// Keep one of every N batches, whole
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    batches: Option<u32>,
    /// Keep one of every N queries, whatever their batch
    #[arg(long = "queries", value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    every: Option<u32>,
    /// Seed: which of each N is kept
    #[arg(long, default_value = "0")]
    seed: u64,
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries --order tiled | pm-reorder hilbert --per batch | pm-sample --batches 16 | pm-gather
  pm-sample --queries 16 hilbert.pmq | pm-gather map.pmp | pm-cachesim";

fn main() -> ExitCode {
    cli::main("pm-sample", run)
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    let name = named(&args.input);
    let mut queries = RecordReader::<Query, _>::from_blocks(open_input(&args.input)?).context(name.clone())?;
    let mut header = queries.header().clone();
    let (one_of, what) = match (args.batches, args.every) {
        (Some(n), _) => (n, "batches"),
        (None, n) => (n.unwrap_or(1), "queries"),
    };
    let progress = Progress::new(header.expected_records, "queries", args.voice.quiet);
    header.expected_records = header.expected_records.map(|records| records.div_ceil(one_of.into()));
    header.set_meaning("sample", format!("1 of {one_of} {what}"));
    header.history.push(typed.step_from(&args.input, Some(args.seed)));

    let mut output = RecordWriter::new(args.output.create()?, &header)?;
    let mut choice = Choice { one_of: one_of.into(), seed: args.seed, next: 0 };
    let (mut batch, mut kept_batch) = (None, false);
    let (mut batches, mut batches_kept, mut kept) = (0u64, 0u64, 0u64);
    while let Some((meta, mut records)) = queries.next_block().with_context(|| name.clone())? {
        for (block, tally) in queries.take_beside() {
            output.write_beside(&block, tally)?;
        }
        progress.add(records.len() as u64);
        if batch != Some(meta.batch) {
            batch = Some(meta.batch);
            batches += 1;
            kept_batch = args.batches.is_some() && choice.takes_next();
            batches_kept += u64::from(kept_batch);
        }
        if args.batches.is_none() {
            records.retain(|_| choice.takes_next());
        }
        if kept_batch || args.batches.is_none() {
            kept += records.len() as u64;
            output.write(meta, &records)?;
        }
    }
    for (block, tally) in queries.take_beside() {
        output.write_beside(&block, tally)?;
    }
    drop(progress);
    let given = queries.end()?;
    if batches > 0 && args.batches.is_some() && batches_kept == 0 {
        anyhow::bail!("{name}: none of its {batches} batches was kept; give fewer --batches than it has, or --queries");
    }
    let mut report = StageReport::new(typed.program())
        .with("queries_given", Number::Count(given.tally.records))
        .with("queries_kept", Number::Count(kept))
        .with("share", Number::Real(kept as f64 / given.tally.records.max(1) as f64));
    if args.batches.is_some() {
        report = report.with("batches_given", Number::Count(batches)).with("batches_kept", Number::Count(batches_kept));
    }
    let mut stages = given.stages.clone();
    stages.push(report);
    output.finish(stages)?.commit()
}

/// Which of the things that come one after the other are taken: one of each so many, by a seed.
struct Choice {
    one_of: u64,
    seed: u64,
    next: u64,
}

impl Choice {
    fn takes_next(&mut self) -> bool {
        let (group, place) = (self.next / self.one_of, self.next % self.one_of);
        self.next += 1;
        Random::new(&[self.seed, group]).next_u64() % self.one_of == place
    }
}
