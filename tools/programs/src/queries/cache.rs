//! Cached irradiance, as the stream carries it.

use crate::cli::Output;
use pm_formats::{BLOCK_RECORDS, Query, RecordWriter, encode_irradiance, encode_weights};
use pm_light::transport::{CacheRecords, GatherRays};
use pm_parallel::in_order;

/// Irradiance records to a block: their rays make them large.
const RECORDS_A_BLOCK: usize = 32;

/// Writes the records of cached irradiance and what each pixel takes of them, ahead of all queries.
pub(super) fn write_cache(
    cache: &CacheRecords,
    rays: &GatherRays<'_>,
    [width, height]: [u32; 2],
    threads: usize,
    output: &mut RecordWriter<Query, Output>,
) -> anyhow::Result<()> {
    let mut firsts = (0..cache.len()).step_by(RECORDS_A_BLOCK);
    in_order(
        threads,
        || anyhow::Ok(firsts.next()),
        |first| {
            let ids = first..(first + RECORDS_A_BLOCK).min(cache.len());
            let records: Vec<_> = ids.map(|id| cache.record(rays, id as u32)).collect();
            encode_irradiance(&records)
        },
        |encoded| {
            let (block, tally) = encoded?;
            Ok(output.write_beside(&block, tally)?)
        },
    )?;
    let mut rows = 0..height;
    in_order(
        threads,
        || anyhow::Ok(rows.next()),
        |y| {
            let mut weights = vec![];
            (0..width).for_each(|x| cache.weights(rays, x, y, |weight| weights.push(weight)));
            weights.chunks(BLOCK_RECORDS).map(encode_weights).collect::<Vec<_>>()
        },
        |encoded| {
            for encoded in encoded {
                let (block, tally) = encoded?;
                output.write_beside(&block, tally)?;
            }
            Ok(())
        },
    )
}
