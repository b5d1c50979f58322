//! Traffic besides the map's, as far as a trace tells of it.

use pm_formats::vocabulary::{DeferredLabel, OrderLabel, meaning, measure};
use pm_formats::{End, Header, Number};

/// What stages call the bytes of queries that they wrote to memory and read back.
const SPILLED: [&str; 2] = [measure::SPILLED_WRITTEN, measure::SPILLED_READ];

/// Bytes of queries that the stages before wrote to memory and read back; none if none speaks of it. Where only a share of
/// the queries was kept after that, it is their share of the bytes.
pub(super) fn query_bytes(end: &End) -> u64 {
    let mut bytes = 0.0;
    for (name, number) in end.stages.iter().flat_map(|stage| &stage.measures) {
        match *number {
            Number::Bytes(more) if SPILLED.contains(&name.as_str()) => bytes += more as f64,
            Number::Real(share) if name == measure::SHARE => bytes *= share,
            _ => {}
        }
    }
    bytes.round() as u64
}

/// Bytes on chip that the stages before needed to order the queries; of several stages the sum, since they work at once.
pub(super) fn order_bytes(end: &End) -> u64 {
    let measures = end.stages.iter().flat_map(|stage| &stage.measures);
    let on_chip = measures.filter_map(|(name, number)| match number {
        Number::Bytes(bytes) if name == measure::ON_CHIP => Some(*bytes),
        _ => None,
    });
    on_chip.fold(0, u64::saturating_add)
}

/// Pixels of a tile, if each batch of the trace is one: the queries were made tile by tile (`tiled 16x16`), and whatever
/// was done to their order left them in their batches. Of compact records that is not told.
pub(super) fn tile_pixels(header: &Header) -> Option<u64> {
    let order: OrderLabel = header.meaning(meaning::ORDER)?.parse().ok()?;
    let left_in_batches = |deferred: &str| {
        deferred.parse::<DeferredLabel>().is_ok_and(|deferred| deferred.per_batch && !deferred.compact)
    };
    order.tile_pixels().filter(|_| header.meaning(meaning::DEFERRED_ORDER).is_none_or(left_in_batches))
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
                .with(measure::SPILLED_WRITTEN, Number::Bytes(44))
                .with(measure::SPILLED_READ, Number::Bytes(100))
                .with(measure::STORAGE, Number::Bytes(7))
                .with(measure::SPILLED_READ, Number::Count(1))
        };
        end.stages = vec![stage("pm-reorder"), StageReport::new("pm-gather"), stage("pm-reorder")];
        assert_eq!(query_bytes(&end), 2 * 144);
        // Of a quarter of the queries, and then more.
        end.stages.insert(1, StageReport::new("pm-sample").with(measure::SHARE, Number::Real(0.25)));
        assert_eq!(query_bytes(&end), 36 + 144);
    }

    #[test]
    fn bytes_on_chip_of_all_stages_are_added() {
        let stage = |bytes| {
            StageReport::new("pm-reorder")
                .with(measure::ON_CHIP, Number::Bytes(bytes))
                .with(measure::ON_CHIP, Number::Count(9))
        };
        let end = End { stages: vec![stage(100), StageReport::new("pm-gather"), stage(20)], ..End::default() };
        assert_eq!(order_bytes(&end), 120);
    }

    #[test]
    fn batches_are_tiles_if_the_order_says_so() {
        let tile = |order: &str, deferred: Option<&str>| {
            let mut header = Header::empty();
            header.set_meaning(meaning::ORDER, order);
            deferred.into_iter().for_each(|deferred| header.set_meaning(meaning::DEFERRED_ORDER, deferred));
            tile_pixels(&header)
        };
        assert_eq!(tile("tiled 16x8", None), Some(128));
        assert_eq!(tile("direction-binned 4x4, bins 10", Some("hilbert per batch")), Some(16));
        assert_eq!(tile("tiled 16x16", Some("hilbert")), None);
        assert_eq!(tile("scanline", Some("hilbert per batch")), None);
        assert_eq!(tile_pixels(&Header::empty()), None);
    }
}
