//! The queries that are answered, and what stands before them.

use super::args::Args;
use crate::cli::{Input, check_part_of_picture, named, open_input, refuse_part, usage};
use anyhow::Context as _;
use pm_film::irradiance::CachedIrradiance;
use pm_formats::vocabulary::meaning;
use pm_formats::{Block, BlockReader, Section, StreamKind, Tally, decode_irradiance, decode_weights, part_of};

/// Opens the queries. A part of them gives no picture.
pub(super) fn open(args: &Args) -> anyhow::Result<BlockReader<Input>> {
    let path = &args.first.queries;
    let queries = open_input(path)?.expect_kind(StreamKind::Queries).with_context(|| named(path))?;
    let header = queries.header();
    if args.rest.report.is_some() {
        refuse_part(&named(path), header, "--report describes the lookups of a whole")?;
    }
    let part = part_of(header);
    args.rest.image.iter().try_for_each(|image| check_part_of_picture(image, part).map(|_| ()))?;
    if let Some(sample) = queries.header().meaning(meaning::SAMPLE).filter(|_| !args.rest.image.is_empty()) {
        let name = named(path);
        return Err(usage(format!(
            "--image: {name} is a sample ({sample}), and a part of the queries gives no picture: leave out --image"
        )));
    }
    Ok(queries)
}

/// Reads what stands before the first query: cached irradiance, if there is any. Also returns the first block of
/// queries, and what was read for the digest.
pub(super) fn read_cache(
    queries: &mut BlockReader<Input>,
    gradients: bool,
) -> pm_formats::Result<(CachedIrradiance, Option<Block>, Tally)> {
    let (mut records, mut weights, mut tally) = (vec![], vec![], Tally::default());
    let first = loop {
        let Some(block) = queries.next_block()? else { break None };
        let read = match block.section {
            Section::Records => break Some(block),
            Section::IrradianceRecords => decode_irradiance(&block).map(|(more, tally)| {
                records.extend(more);
                tally
            }),
            _ => decode_weights(&block).map(|(more, tally)| {
                weights.extend(more);
                tally
            }),
        };
        tally += read.ok_or_else(|| queries.damaged("a block beside the queries does not hold what it says"))?;
    };
    let cache = CachedIrradiance::new(records, weights, queries.header().pixels(), gradients);
    let cache = cache.ok_or_else(|| queries.damaged("a pixel takes irradiance that is not cached"))?;
    Ok((cache, first, tally))
}
