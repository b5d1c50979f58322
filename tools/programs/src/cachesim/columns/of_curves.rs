//! The table of sizes of curves.

use super::super::curve_point::CurvePoint;
use super::{Columns, perhaps};
use pm_caches::Estimate;
use pm_report::{Format, Table};

/// The table of sizes of curves. Columns of the sample are there if there is one.
pub(in super::super) fn of_curves(format: Format, points: &[CurvePoint]) -> Table {
    let lanes = points.iter().any(|of| of.lanes > 1);
    let exact = points.iter().any(|of| of.exact.is_some());
    let mut columns = Columns::new()
        .text("trace", false, |of: &CurvePoint| of.file.to_string())
        .text("map", false, |of| of.map.to_string())
        .text("order", true, |of| of.order.clone())
        .text("cache", true, CurvePoint::cache)
        .count("lanes", lanes, |of| of.lanes.into())
        .count("cache_lines", true, |of| of.lines)
        .count("cache_bytes", false, CurvePoint::bytes)
        .count("queries", false, |of| of.trace.queries)
        .count("reads", false, |of| of.trace.records.reads)
        .count("accesses", false, |of| of.trace.accesses);
    if exact {
        columns = columns
            .number("fetches", true, |of| perhaps(of.fetches()))
            .number("bytes_fetched", true, |of| perhaps(of.fetches().map(|lines| of.bytes_of(lines))))
            .count_perhaps("bytes_written_back", |of| of.write_backs().map(|lines| of.bytes_of(lines)))
            .count_perhaps("compulsory", |of| Some(of.exact.as_ref()?.compulsory))
            .count_perhaps("capacity", |of| Some(of.fetches()? - of.exact.as_ref()?.compulsory));
    }
    if points.iter().any(|of| of.sampled.is_some()) {
        let estimate = |of: &CurvePoint, number: fn(Estimate) -> f64| of.estimate().map_or(f64::NAN, number);
        columns = columns
            .ratio("sampled_rate", false, |of| of.sampled.as_ref().map_or(f64::NAN, |curve| curve.rate))
            .ratio("sampled_fetches", true, move |of| estimate(of, |estimate| estimate.fetches))
            .ratio("plus_or_minus", true, move |of| estimate(of, |estimate| estimate.error));
        if exact {
            let off = move |of: &CurvePoint| estimate(of, |estimate| estimate.fetches) / of.best() - 1.0;
            columns = columns.ratio("sampled_off", true, off);
        }
    }
    columns = columns
        .count("blocks", false, |of| of.trace.blocks)
        .ratio("fetches_per_query", true, |of| of.best() / of.trace.queries as f64)
        .ratio("fetches_per_block", true, |of| of.best() / of.trace.blocks as f64);
    if exact {
        columns = columns.ratio("bytes_per_query", false, |of| of.traffic() / of.trace.queries as f64).text(
            "mark",
            true,
            |of| of.mark().to_owned(),
        );
    }
    columns.text("history", false, |of| of.history.to_string()).table(format, points)
}
