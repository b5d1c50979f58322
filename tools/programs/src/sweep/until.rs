//! `pm-sweep until`: windows of a stream are added until fetches per query are known as well as asked.

use crate::cli::{create_output, say, usage};
use crate::pipe::Pipe;
use pm_sampling::{Missing, Tuning};
use pm_sweep::until::Samples;
use std::io::Write as _;
use std::path::Path;

/// Add windows of a stream until fetches per query are known as well as asked, and print one row of CSV.
///
/// First a pilot, then as many more windows as its spread says are missing, chosen by another seed, and so on. What is chosen
/// never depends on what was found but by its number. The programs are those beside this one, or in the folder BIN.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Half the width of the 95 % interval, in percent of the value; without it, the pilot is all
    #[arg(long, value_name = "P%", value_parser = percent)]
    until: Option<f64>,
    /// Windows to begin with
    #[arg(long, value_name = "N", default_value = "400", value_parser = clap::value_parser!(u64).range(1..))]
    pilot: u64,
    /// No more windows than so many
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    most: Option<u64>,
    /// Which windows are chosen
    #[arg(long, value_name = "N", default_value = "0", value_parser = clap::value_parser!(u64).range(..1 << 50))]
    seed: u64,
    /// Rays of a window; without it, whole batches (tiles or scanlines)
    #[arg(long, value_name = "RAYS")]
    window: Option<u64>,
    /// Rays before each window that fill the cache
    #[arg(long, value_name = "RAYS", default_value = "64")]
    warm_up: u64,
    /// Options of pm-queries
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true)]
    queries: Option<String>,
    /// Order and options of pm-reorder; without it, there is no pm-reorder
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true)]
    reorder: Option<String>,
    /// Options of pm-gather
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true)]
    gather: Option<String>,
    /// Options of pm-cachesim
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true)]
    cachesim: Option<String>,
    /// Tell nothing on the way
    #[arg(short, long)]
    quiet: bool,
}

/// Rounds of a seed are seeds from here; another seed's are a thousand further on.
const FIRST_ROUND: u64 = 100;

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let words = |option: &Option<String>| {
        let text = option.as_deref().unwrap_or_default();
        let words = shlex::split(text).ok_or_else(|| usage(format!("`{text}`: a quote is not closed")))?;
        anyhow::Ok(std::iter::once("-q".to_owned()).chain(words).collect::<Vec<_>>())
    };
    let (queries, gather, cachesim) = (words(&args.queries)?, words(&args.gather)?, words(&args.cachesim)?);
    let reorder = args.reorder.as_ref().map(|_| words(&args.reorder)).transpose()?;

    let tuning = Tuning { until: args.until, pilot: args.pilot, most: args.most };
    let (mut sample, mut samples) = (tuning.begin(), Samples::default());
    while let Some(round) = sample.next_round() {
        let seed = args.seed * 1000 + FIRST_ROUND + round.number;
        let chosen = ["--only-tiles".into(), round.windows.to_string(), "--sample-seed".into(), seed.to_string()];
        let mut pipe = Pipe::new("pm-queries", queries.iter().cloned().chain(chosen));
        if let Some(window) = args.window {
            pipe = pipe.with(["--window".into(), window.to_string(), "--warm-up".into(), args.warm_up.to_string()]);
        }
        if let Some(reorder) = &reorder {
            pipe = pipe.then("pm-reorder", reorder.iter().cloned());
        }
        pipe = pipe.then("pm-gather", gather.iter().cloned());
        pipe = pipe.then("pm-cachesim", ["--format".into(), "csv".into()].into_iter().chain(cachesim.iter().cloned()));
        let ratio = samples.add(&pipe.run()?)?;
        sample.add(round, ratio);
        if let Some(ratio) = sample.ratio().filter(|_| !args.quiet) {
            say(samples.in_words(&ratio));
        }
    }
    let ratio = sample.ratio().ok_or_else(|| usage("--pilot: at least one window is wanted"))?;
    if sample.missing() == Missing::Certainty {
        say("too much is in doubt for --until: longer --warm-up, or longer windows, fill the cache");
    }
    let mut output = create_output(Path::new("-"))?;
    output.write_all(&samples.together(&ratio)?.to_csv())?;
    output.commit()
}

/// A share of 1 from percent.
fn percent(text: &str) -> Result<f64, String> {
    let number = text.strip_suffix('%').filter(|number| number.chars().all(|c| c.is_ascii_digit() || c == '.'));
    match number.and_then(|number| number.parse::<f64>().ok()).filter(|&percent| percent > 0.0) {
        Some(percent) => Ok(percent / 100.0),
        None => Err("percent are expected, such as 1%".into()),
    }
}
