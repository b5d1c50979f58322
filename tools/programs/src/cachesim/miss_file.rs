//! The stream of one cache's misses, as a trace for a further cache.

use super::questions::Questions;
use super::results::{Results, Source};
use super::{Args, Registries, simulate, windowed};
use crate::cli::{Output, OutputArgs, Progress, Typed, named, refuse_part, usage};
use anyhow::Context as _;
use pm_caches::{CacheCounts, MissStream};
use pm_exchange::traces::{Opened, header_of};
use pm_formats::trace::TraceReader;
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{Number, StageReport};
use std::path::Path;

/// Simulates one cache and writes what it fetches.
pub(super) fn write(
    args: &Args,
    typed: &Typed,
    registries: &Registries,
    questions: &Questions,
    file: &Path,
    results: &mut Results,
) -> anyhow::Result<()> {
    let (&[cache], [path]) = (&questions.caches[..], &args.traces[..]) else {
        return Err(usage("--misses is for one --cache and one trace"));
    };
    if !cache.keeps_lines() {
        return Err(usage("--misses: without a cache nothing is kept back; name one that has lines"));
    }
    let mut step = typed.step_from(path, None);
    step.arguments = misses_to_pipe(step.arguments);
    let through = |before: Option<&str>| before.map_or(cache.to_string(), |first| format!("{first}, {cache}"));
    let report = |counts: &CacheCounts| {
        StageReport::new(typed.program())
            .with(measure::ACCESSES, Number::Count(counts.accesses))
            .with("fetches", Number::Count(counts.fetches))
            .with("bytes_fetched", Number::Bytes(counts.bytes_fetched))
            .with("bytes_written_back", Number::Bytes(counts.bytes_written_back))
    };
    let name = named(path);
    let output = || OutputArgs { output: Some(file.to_owned()) }.create();
    let (output, source, findings) = match simulate::open(args, path, &registries.imports)? {
        Opened::Ours(blocks) => {
            let mut trace = TraceReader::from_blocks(blocks).context(name.clone())?;
            refuse_part(&name, trace.header(), "a cache goes on from batch to batch")?;
            if windowed::sample(trace.header()).context(name.clone())?.is_some() {
                windowed::refuse(args).context(name.clone())?;
            }
            let measures = questions.measures_of(trace.header());
            let mut header = trace.header().clone();
            header.set_meaning(meaning::MISSES_OF, through(header.meaning(meaning::MISSES_OF)));
            header.history.push(step);
            let mut stream = MissStream::new(output()?, header, cache, &measures).context(name.clone())?;
            let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
            while let Some(block) = trace.replay_block(&mut stream).with_context(|| name.clone())? {
                stream.check().with_context(|| name.clone())?;
                stream.end_block(block)?;
                progress.add(u64::from(block.records));
            }
            drop(progress);
            let end = trace.end()?.clone();
            let stages = |counts: &CacheCounts| end.stages.iter().cloned().chain([report(counts)]).collect();
            let (output, findings) = stream.finish(stages)?;
            (output, Source::ours(path, trace.header(), &end), findings)
        }
        Opened::Foreign(mut trace) => {
            let mut header = header_of(&trace, step);
            header.set_meaning(meaning::MISSES_OF, through(None));
            let measures = questions.measures_of_addresses();
            let mut stream = MissStream::new(output()?, header, cache, &measures).context(name.clone())?;
            let end_block = |stream: &mut MissStream<Output>, block| {
                stream.check()?;
                Ok(stream.end_block(block)?)
            };
            trace.replay_blocks(&mut stream, end_block).with_context(|| name.clone())?;
            simulate::remark_left_out(args, &name, &trace);
            let source = Source::foreign(path, trace.format().word().to_owned(), trace.regions());
            let (output, findings) = stream.finish(|counts| vec![report(counts)])?;
            (output, source, findings)
        }
    };
    let written_back = findings.caches[0].bytes_written_back;
    if written_back > 0 && !args.write_backs {
        args.voice.remark(format!(
            "{written_back} bytes that the cache writes back are not in the stream of its misses: --write-backs puts them there"
        ));
    }
    output.commit()?;
    results.add(args, &source, 1, findings)
}

/// The arguments as they stand in the history: the stream does not know its name, nor how the table was printed.
fn misses_to_pipe(typed: Vec<String>) -> Vec<String> {
    let mut kept = vec![];
    let mut words = typed.into_iter();
    while let Some(word) = words.next() {
        match word.split_once('=').map_or(word.as_str(), |(name, _)| name) {
            name @ ("--misses" | "--format") => {
                if !word.contains('=') {
                    words.next();
                }
                if name == "--misses" {
                    kept.extend(["--misses".to_owned(), "-".to_owned()]);
                }
            }
            _ => kept.push(word),
        }
    }
    kept
}
