//! Traffic besides the map's, as far as a trace tells of it.

use pm_formats::{End, Header, Number};

/// What stages call the bytes of queries that they wrote to memory and read back.
const SPILLED: [&str; 2] = ["spilled_written", "spilled_read"];

/// Bytes of queries that the stages before wrote to memory and read back; none if none speaks of it.
pub(crate) fn query_bytes(end: &End) -> u64 {
    let measures = end.stages.iter().flat_map(|stage| &stage.measures);
    let spilled = measures.filter_map(|(name, number)| match number {
        Number::Bytes(bytes) if SPILLED.contains(&name.as_str()) => Some(*bytes),
        _ => None,
    });
    spilled.fold(0, u64::saturating_add)
}

/// Pixels of a tile, if each batch of the trace is one: the queries were made tile by tile (`tiled 16x16`), and whatever
/// was done to their order left them in their batches.
pub(crate) fn tile_pixels(header: &Header) -> Option<u64> {
    let order =
        header.meaning("order").filter(|order| ["tiled", "direction-binned"].iter().any(|by| order.starts_with(by)))?;
    if !header.meaning("deferred order").is_none_or(|deferred| deferred.ends_with("per batch")) {
        return None;
    }
    order.split_whitespace().find_map(|word| {
        let (width, height) = word.trim_end_matches(',').split_once('x')?;
        width.parse::<u64>().ok()?.checked_mul(height.parse().ok()?)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_formats::StageReport;

    #[test]
    fn spilled_bytes_of_all_stages_are_added() {
        let mut end = End::default();
        assert_eq!(query_bytes(&end), 0);
        let stage = |program| {
            StageReport::new(program)
                .with("spilled_written", Number::Bytes(44))
                .with("spilled_read", Number::Bytes(100))
                .with("storage", Number::Bytes(7))
                .with("spilled_read", Number::Count(1))
        };
        end.stages = vec![stage("pm-reorder"), StageReport::new("pm-gather"), stage("pm-reorder")];
        assert_eq!(query_bytes(&end), 2 * 144);
    }

    #[test]
    fn batches_are_tiles_if_the_order_says_so() {
        let tile = |order: &str, deferred: Option<&str>| {
            let mut header = Header::empty();
            header.set_meaning("order", order);
            deferred.into_iter().for_each(|deferred| header.set_meaning("deferred order", deferred));
            tile_pixels(&header)
        };
        assert_eq!(tile("tiled 16x8", None), Some(128));
        assert_eq!(tile("direction-binned 4x4, 10 bins", Some("hilbert per batch")), Some(16));
        assert_eq!(tile("tiled 16x16", Some("hilbert")), None);
        assert_eq!(tile("scanline", Some("hilbert per batch")), None);
        assert_eq!(tile_pixels(&Header::empty()), None);
    }
}
