//! `pm-reorder`: puts a stream of gather queries into another order, changing nothing else.

mod args;
mod memory;
mod photons;

use crate::cli::{Outcome, Output, Program, Progress, Typed, named, open_input, refuse_part, usage};
use anyhow::Context as _;
use args::Args;
use photons::Photons;
use pm_formats::vocabulary::{DeferredLabel, SampleUnit, meaning};
use pm_formats::{Block, BlockMeta, Header, Query, RecordReader, RecordWriter, StageReport, Step, Tally};
use pm_orders::{Order, Per, Reordering, Setting, Store, StoredQuery};
use pm_registry::Registry;
use std::ffi::OsString;
use std::process::ExitCode;

/// The program, as a process, with these orders.
#[must_use]
pub fn main(orders: &Registry<dyn Order>) -> ExitCode {
    program(orders).main(reorder)
}

/// A run of the program with these orders and arguments.
pub fn run<T: Into<OsString>>(orders: &Registry<dyn Order>, arguments: impl IntoIterator<Item = T>) -> Outcome {
    program(orders).run(arguments, reorder)
}

fn program(orders: &Registry<dyn Order>) -> Program<Args> {
    let (command, read) = args::command(orders);
    Program::new("pm-reorder", command, read)
}

fn reorder(args: Args, typed: &Typed) -> anyhow::Result<()> {
    let Args { order, first, rest } = &args;
    let store = Store { bytes: first.storage.0, record: first.record };
    let photons = Photons::read(&args)?;
    let name = named(&first.queries);
    let mut queries = RecordReader::<Query, _>::from_blocks(open_input(&first.queries)?).context(name.clone())?;
    let mut header = queries.header().clone();
    check_sample(&args, &name, &header)?;
    if first.per == Per::Image {
        refuse_part(&name, &header, "the order of the whole image is none of its parts': give --per batch")?;
    }
    let label = DeferredLabel {
        order: order.entry.label(&order.values, store),
        per_batch: first.per == Per::Batch,
        compact: store.record == StoredQuery::Compact,
    };
    header.set_meaning(meaning::DEFERRED_ORDER, label);
    let inputs = photons.iter().map(|photons| (photons.name.clone(), photons.history.clone())).collect();
    header.history.push(Step { inputs, ..typed.step_from(&first.queries, order.values.seed()) });

    let setting = Setting {
        values: &order.values,
        bounds: header.bounds,
        store,
        photons: photons.map(|photons| photons.positions),
        limits: memory::limits(&args, &header),
    };
    let mut order = Reordering::new(first.per, order.entry.build(setting)?);
    let mut output = rest.output.begin(&header)?;
    let progress = Progress::new(header.expected_records, "queries", rest.voice.quiet);
    while let Some((meta, records)) = queries.next_block().with_context(|| name.clone())? {
        pass_on(queries.take_beside(), &mut output)?;
        order.push(meta, &records, &mut |meta: BlockMeta, queries: &[Query]| output.write(meta, queries))?;
        progress.add(records.len() as u64);
    }
    pass_on(queries.take_beside(), &mut output)?;
    order.drain(&mut |meta: BlockMeta, queries: &[Query]| output.write(meta, queries))?;
    let mut report = StageReport::new(typed.program());
    report.measures = order.measures();
    output.finish_with_same_records(queries.end()?, report)?.commit()
}

/// Windows of a stream stay apart.
fn check_sample(args: &Args, name: &str, header: &Header) -> anyhow::Result<()> {
    let Some(sample) = header.meaning(meaning::SAMPLE).filter(|_| header.meaning(meaning::SAMPLE_WINDOWS).is_some())
    else {
        return Ok(());
    };
    if args.first.per == Per::Image {
        return Err(usage(format!(
            "{name} holds {sample}, which stay apart: give --per batch, or take the sample after reordering"
        )));
    }
    if header.meaning(meaning::SAMPLE_OF).and_then(|of| of.parse().ok()) != Some(SampleUnit::Batches) {
        args.rest.voice.remark(format!(
            "{name} holds {sample}: the queries of each are ordered by themselves, which is not the order of all"
        ));
    }
    Ok(())
}

/// Writes blocks that stand beside the queries as they are.
fn pass_on(blocks: Vec<(Block, Tally)>, output: &mut RecordWriter<Query, Output>) -> anyhow::Result<()> {
    for (block, tally) in blocks {
        output.write_beside(&block, tally)?;
    }
    Ok(())
}
