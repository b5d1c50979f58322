//! How measures of parts become those of the whole.

use crate::container::Number;
use crate::vocabulary::measure::{
    ACCESSES, ATTEMPTS, EYE_RAYS, EYE_RAYS_AGAIN, GATHER_RAYS, GATHER_RAYS_CONTINUED, GATHER_RAYS_LOST,
    GATHER_RAYS_OF_ALL, LOOKUPS_WITHOUT_AREA, LOOKUPS_WITHOUT_SITE, ON_CHIP, PARTITIONS, PARTITIONS_OVERFLOWING,
    PEAK_QUERIES_HELD, POINTS_GUIDED, PREPASS_RAYS, QUERIES, RAYS_CAST_AGAIN, SHORT_LOOKUPS, SPILLED_READ,
    SPILLED_WRITTEN, STORAGE, STORAGE_COMPACT,
};

/// What of the whole the parts of a stream tell together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OfParts {
    /// The sum of what they tell.
    Sum,
    /// The greatest.
    Greatest,
    /// What all of them tell alike: it is of the whole, or of all they were made from.
    Same,
}

/// How a measure of parts becomes the whole's, in a stage that has these measures.
pub(super) fn of_parts(name: &str, stage: &[(String, Number)]) -> OfParts {
    const SUMS: [&str; 16] = [
        EYE_RAYS_AGAIN,
        GATHER_RAYS,
        GATHER_RAYS_LOST,
        GATHER_RAYS_CONTINUED,
        POINTS_GUIDED,
        SPILLED_WRITTEN,
        SPILLED_READ,
        RAYS_CAST_AGAIN,
        PARTITIONS_OVERFLOWING,
        PREPASS_RAYS,
        QUERIES,
        ACCESSES,
        ATTEMPTS,
        SHORT_LOOKUPS,
        LOOKUPS_WITHOUT_AREA,
        LOOKUPS_WITHOUT_SITE,
    ];
    const GREATEST: [&str; 5] = [PEAK_QUERIES_HELD, STORAGE, STORAGE_COMPACT, ON_CHIP, PARTITIONS];
    // To know where windows of rays lie, each part casts all eye rays once.
    let windows = || stage.iter().any(|(name, _)| name == GATHER_RAYS_OF_ALL);
    if SUMS.contains(&name) || (name == EYE_RAYS && !windows()) {
        OfParts::Sum
    } else if GREATEST.contains(&name) {
        OfParts::Greatest
    } else {
        OfParts::Same
    }
}
