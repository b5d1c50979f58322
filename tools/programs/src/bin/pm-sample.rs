//! Keeps a share of a stream of gather queries, so that no more is simulated than an answer needs.

#[path = "pm-sample/cutter.rs"]
mod cutter;

use anyhow::Context as _;
use clap::{ArgGroup, Parser};
use cutter::Cutter;
use pm_formats::vocabulary::{SampleUnit, meaning, measure};
use pm_formats::{Header, Number, Query, RecordReader, StageReport};
use pm_programs::cli::{self, OutputArgs, Progress, Typed, Voice, named, open_input, refuse_part, usage};
use pm_random::Random;
use pm_sampling::windows::StratifiedStream;
use std::path::PathBuf;
use std::process::ExitCode;

/// Keep a share of the gather queries: windows of consecutive ones, whole batches, or single ones.
///
/// Take the sample after reordering. --every keeps one window in each so many queries, for pm-cachesim to estimate the
/// whole from: a window is a batch of its own, simulated by itself, and begins with an empty cache, which its warm-up
/// fills. --batches keeps one of every N batches (scanlines, tiles) in a row. Which one the seed decides, so that no step
/// falls in with the width of the picture. Orders of the whole image are one batch, and their working set is the
/// picture's: thin them by --queries. The end block tells the share; what the stages before measured is of the whole
/// stream. Tables of cached irradiance beside the queries are passed on whole. `pm-queries --only-tiles` takes such
/// samples before rays are cast.
#[derive(Parser)]
#[command(after_help = EXAMPLES, group = ArgGroup::new("what").required(true).args(["every", "batches", "queries"]))]
struct Args {
    /// Queries to read; `-` is standard input
    #[arg(default_value = "-")]
    input: PathBuf,
    /// Keep one --window of every N queries, a multiple of it
    #[arg(long, value_name = "N", requires = "window", value_parser = clap::value_parser!(u64).range(1..))]
    every: Option<u64>,
    /// Consecutive queries of each window of --every
    #[arg(long, value_name = "N", requires = "every", value_parser = clap::value_parser!(u64).range(1..))]
    window: Option<u64>,
    /// Queries before each window that fill the cache; they are marked as warm-up and not counted
    #[arg(long, value_name = "N", requires = "every", default_value = "64")]
    warm_up: u32,
    /// Keep one of every N batches, whole
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    batches: Option<u32>,
    /// Keep one of every N queries, whatever their batch
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    queries: Option<u32>,
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
  pm-queries | pm-sample --every 25000 --window 250 | pm-gather | pm-cachesim
  pm-queries --order tiled | pm-reorder hilbert --per batch | pm-sample --batches 16 | pm-gather
  pm-sample --queries 16 hilbert.pmq | pm-gather map.pmp | pm-cachesim";

fn main() -> ExitCode {
    cli::main("pm-sample", run)
}

/// What is kept.
enum Sample {
    Windows(Cutter),
    Batches(OneOf),
    Queries(OneOf),
}

impl Sample {
    fn new(args: &Args) -> anyhow::Result<Self> {
        let one_of = |n: u32| OneOf { one_of: n.into(), seed: args.seed, next: 0 };
        if let (Some(every), Some(window)) = (args.every, args.window) {
            let windows = StratifiedStream::new(every, window, args.seed).ok_or_else(|| {
                let less = (every / window).max(1).saturating_mul(window);
                let more = less.saturating_add(window);
                usage(format!("--every {every} is not a multiple of --window {window}: {less} or {more} would do"))
            })?;
            return Ok(Self::Windows(Cutter::new(windows, args.warm_up as usize)));
        }
        Ok(match (args.batches, args.queries) {
            (Some(n), _) => Self::Batches(one_of(n)),
            (None, n) => Self::Queries(one_of(n.unwrap_or(1))),
        })
    }

    /// Says in the header what the stream holds of the one that is read.
    fn describe(&self, args: &Args, name: &str, header: &mut Header) -> anyhow::Result<()> {
        let windows = matches!(self, Self::Windows(_));
        if let Some(sample) = header.meaning(meaning::SAMPLE)
            && (windows || header.meaning(meaning::SAMPLE_WINDOWS).is_some())
        {
            return Err(usage(format!("{name} is a sample already ({sample}): take the sample of the whole stream")));
        }
        let all = header.expected_records;
        match self {
            Self::Windows(_) => {
                let (every, window) = (args.every.unwrap_or(1), args.window.unwrap_or(1));
                let warm_up = args.warm_up;
                header.expected_records =
                    all.map(|all| all.div_ceil(every).saturating_mul(window + u64::from(warm_up)));
                header
                    .set_meaning(meaning::SAMPLE, format!("windows of {window} queries after {warm_up}, 1 in {every}"));
                header.set_meaning(meaning::SAMPLE_OF, SampleUnit::Queries);
                // How long the stream is, and with it their number, shows at its end only.
                header.set_meaning(meaning::SAMPLE_WINDOWS, 0);
                header.set_meaning(meaning::SAMPLE_SHARE, window as f64 / every as f64);
            }
            Self::Batches(OneOf { one_of, .. }) => {
                header.expected_records = all.map(|all| all.div_ceil(*one_of));
                header.set_meaning(meaning::SAMPLE, format!("1 of {one_of} batches"));
            }
            Self::Queries(OneOf { one_of, .. }) => {
                header.expected_records = all.map(|all| all.div_ceil(*one_of));
                header.set_meaning(meaning::SAMPLE, format!("1 of {one_of} queries"));
            }
        }
        Ok(())
    }
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    let name = named(&args.input);
    let mut sample = Sample::new(&args)?;
    let mut queries = RecordReader::<Query, _>::from_blocks(open_input(&args.input)?).context(name.clone())?;
    let mut header = queries.header().clone();
    let progress = Progress::new(header.expected_records, "queries", args.voice.quiet);
    refuse_part(&name, &header, "a sample is chosen of all batches")?;
    sample.describe(&args, &name, &mut header)?;
    header.history.push(typed.step_from(&args.input, Some(args.seed)));

    let mut output = args.output.begin(&header)?;
    let (mut batch, mut kept_batch) = (None, false);
    let (mut batches, mut batches_kept, mut kept) = (0u64, 0u64, 0u64);
    while let Some((meta, mut records)) = queries.next_block().with_context(|| name.clone())? {
        for (block, tally) in queries.take_beside() {
            output.write_beside(&block, tally)?;
        }
        progress.add(records.len() as u64);
        let new_batch = batch != Some(meta.batch);
        batch = Some(meta.batch);
        batches += u64::from(new_batch);
        match &mut sample {
            Sample::Windows(cutter) => {
                cutter.cut(&records, |meta, queries| output.write(meta, queries))?;
                kept = cutter.measured;
            }
            Sample::Batches(choice) => {
                if new_batch {
                    kept_batch = choice.takes_next();
                    batches_kept += u64::from(kept_batch);
                }
                if kept_batch {
                    kept += records.len() as u64;
                    output.write(meta, &records)?;
                }
            }
            Sample::Queries(choice) => {
                records.retain(|_| choice.takes_next());
                kept += records.len() as u64;
                output.write(meta, &records)?;
            }
        }
    }
    for (block, tally) in queries.take_beside() {
        output.write_beside(&block, tally)?;
    }
    drop(progress);
    let given = queries.end()?;
    let all = given.tally.records;
    let mut report = StageReport::new(typed.program())
        .with(measure::QUERIES_GIVEN, Number::Count(all))
        .with(measure::QUERIES_KEPT, Number::Count(kept))
        .with(measure::SHARE, Number::Real(kept as f64 / all.max(1) as f64));
    match sample {
        Sample::Batches(_) => {
            if batches > 0 && batches_kept == 0 {
                anyhow::bail!(
                    "{name}: none of its {batches} batches was kept; give fewer --batches than it has, or --queries"
                );
            }
            report = report
                .with(measure::BATCHES_GIVEN, Number::Count(batches))
                .with(measure::BATCHES_KEPT, Number::Count(batches_kept));
        }
        Sample::Windows(cutter) => {
            if all > 0 && kept == 0 {
                anyhow::bail!("{name}: no window lies within its {all} queries; give a smaller --every");
            }
            if batches == 1 {
                args.voice.remark(format!(
                    "{name} is one batch, as orders of the whole image are: windows may be too short to fill the cache \
                     (pm-cachesim tells); --queries thins the stream instead"
                ));
            }
            report = report
                .with(measure::WINDOWS, Number::Count(all.div_ceil(args.every.unwrap_or(1))))
                .with(measure::QUERIES_OF_WARM_UP, Number::Count(cutter.warm_ups));
        }
        Sample::Queries(_) => {}
    }
    let mut stages = given.stages.clone();
    stages.push(report);
    output.finish(stages)?.commit()
}

/// Which of the things that come one after the other are taken: one of each so many, by a seed.
struct OneOf {
    one_of: u64,
    seed: u64,
    next: u64,
}

impl OneOf {
    fn takes_next(&mut self) -> bool {
        let (group, place) = (self.next / self.one_of, self.next % self.one_of);
        self.next += 1;
        Random::new(&[self.seed, group]).next_u64() % self.one_of == place
    }
}
