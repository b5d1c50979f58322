//! All queries answered, block by block, on many threads and put together in their order.

use super::pictures::Films;
use crate::cli::{Common, Input, Output, Progress};
use anyhow::Context as _;
use pm_formats::trace::TraceWriter;
use pm_formats::{Block, BlockReader, End, Tally};
use pm_gathering::{Answered, Answerer, Fault, Lookups, SearchCounts};
use pm_parallel::in_order;
use std::cell::RefCell;
use std::time::Instant;

/// Queries as they are read.
pub(super) struct Asked {
    /// How the stream is called in messages.
    pub(super) name: String,
    pub(super) blocks: BlockReader<Input>,
    /// The first block, which is read already.
    pub(super) first: Option<Block>,
    /// What was read for the digest before it.
    pub(super) beside: Tally,
}

/// What was done.
pub(super) struct Done {
    pub(super) counts: SearchCounts,
    /// Number and digest of the queries.
    pub(super) tally: Tally,
    /// What the lookups were like, if that is wanted.
    pub(super) lookups: Option<Lookups>,
    pub(super) seconds: f64,
    /// The end block of the queries.
    pub(super) end: End,
}

/// Answers all queries: their reads go into the trace, their light onto the films.
pub(super) fn answer_all(
    answerer: &Answerer<'_>,
    asked: Asked,
    common: &Common,
    films: &mut Films,
    mut trace: Option<&mut TraceWriter<Output>>,
) -> anyhow::Result<Done> {
    let Asked { name, blocks, mut first, beside: mut tally } = asked;
    let progress = Progress::new(answerer.header.expected_records, "queries", common.quiet);
    let blocks = RefCell::new(blocks);
    let mut counts = SearchCounts::default();
    let mut lookups: Option<Lookups> = None;
    let start = Instant::now();
    in_order(
        common.threads(),
        || match first.take() {
            Some(block) => Ok(Some(block)),
            None => blocks.borrow_mut().next_block().with_context(|| name.clone()),
        },
        |block| answerer.answer(&block),
        |answered: Result<Answered, Fault>| {
            let answered = answered.map_err(|fault| match fault {
                Fault::Damaged(what) => anyhow::Error::from(blocks.borrow().damaged(what)).context(name.clone()),
                Fault::TooBright(overflow) => overflow.into(),
                Fault::Format(error) => error.into(),
            })?;
            if let (Some(trace), Some((block, tally))) = (&mut trace, &answered.trace) {
                trace.write(block, *tally)?;
            }
            films.add(&answered)?;
            progress.add(answered.tally.records);
            tally += answered.tally;
            counts += answered.counts;
            match (&mut lookups, answered.lookups) {
                (Some(lookups), Some(more)) => *lookups += more,
                (none, more) => *none = more,
            }
            Ok(())
        },
    )?;
    drop(progress);
    let seconds = start.elapsed().as_secs_f64();
    let end = blocks.into_inner().end(tally).context(name)?.clone();
    Ok(Done { counts, tally, lookups, seconds, end })
}

impl Done {
    /// Says what there is to say about it.
    pub(super) fn remark(&self, common: &Common) {
        let (counts, queries) = (self.counts, self.tally.records);
        if counts.no_area > 0 {
            common.remark(format!(
                "{} of {queries} queries have all their photons at one point: nothing was added for them (a larger k helps)",
                counts.no_area
            ));
        }
        if counts.no_site > 0 {
            common.remark(format!(
                "{} of {queries} queries searched all the same: nothing precomputed is known of their surface near them",
                counts.no_site
            ));
        }
    }
}
