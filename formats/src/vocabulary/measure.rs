//! Names of what stages measure that others read in the end block ([`End::measure`](crate::End::measure)).
//!
//! A stage may measure more, for people: what no other program and no test reads has its name where it is measured.

/// Paths that left the lights, by which the photons' powers are to be divided.
pub const EMITTED_PATHS: &str = "emitted_paths";

/// Rays from the eye.
pub const EYE_RAYS: &str = "eye_rays";
/// Those of them that were cast before, for an earlier pass.
pub const EYE_RAYS_AGAIN: &str = "eye_rays_again";
/// Rays that look for a place to gather at.
pub const GATHER_RAYS: &str = "gather_rays";
/// Those of them that found none.
pub const GATHER_RAYS_LOST: &str = "gather_rays_lost";
/// Of a sample in windows: gather rays of the whole picture.
pub const GATHER_RAYS_OF_ALL: &str = "gather_rays_of_all";
/// Of a sample in windows: gather rays of the windows, warm-up not counted.
pub const GATHER_RAYS_MEASURED: &str = "gather_rays_measured";

/// Queries before a share of them was kept.
pub const QUERIES_GIVEN: &str = "queries_given";
/// Queries that were kept, warm-up not counted.
pub const QUERIES_KEPT: &str = "queries_kept";
/// Queries that were kept to fill the cache only.
pub const QUERIES_OF_WARM_UP: &str = "queries_of_warm_up";
/// Batches before some of them were chosen.
pub const BATCHES_GIVEN: &str = "batches_given";
/// Batches that were chosen.
pub const BATCHES_KEPT: &str = "batches_kept";
/// Share of the queries that was kept; what earlier stages measured is of all.
pub const SHARE: &str = "share";
/// Windows of the stream, had they all been kept whole.
pub const WINDOWS: &str = "windows";

/// Most queries that were held at a time.
pub const PEAK_QUERIES_HELD: &str = "peak_queries_held";
/// Bytes of those, all of each stored.
pub const STORAGE: &str = "storage";
/// Bytes of those, a compact record of each stored.
pub const STORAGE_COMPACT: &str = "storage_compact";
/// Bytes on chip that ordering took.
pub const ON_CHIP: &str = "on_chip";
/// Bytes of queries written to memory because the chip had no room.
pub const SPILLED_WRITTEN: &str = "spilled_written";
/// Bytes of those read back.
pub const SPILLED_READ: &str = "spilled_read";
/// Rays cast again to get queries back from compact records.
pub const RAYS_CAST_AGAIN: &str = "rays_cast_again";
/// Of partitions of a batch: the most there were.
pub const PARTITIONS: &str = "partitions";
/// Partitions that were larger than the store.
pub const PARTITIONS_OVERFLOWING: &str = "partitions_overflowing";
/// Rays of the samples that decided where partitions end.
pub const PREPASS_RAYS: &str = "prepass_rays";

/// Gather rays that went on because they were short.
pub const GATHER_RAYS_CONTINUED: &str = "gather_rays_continued";
/// Points seen whose gather rays photons guided.
pub const POINTS_GUIDED: &str = "points_guided";

/// Queries that were answered, or read.
pub const QUERIES: &str = "queries";
/// Records that searches read.
pub const ACCESSES: &str = "accesses";
/// Attempts that searches took.
pub const ATTEMPTS: &str = "attempts";
/// Searches that found fewer photons than they wanted.
pub const SHORT_LOOKUPS: &str = "short_lookups";
/// Searches whose photons lie at one point.
pub const LOOKUPS_WITHOUT_AREA: &str = "lookups_without_area";
/// Searches for precomputed irradiance that found none.
pub const LOOKUPS_WITHOUT_SITE: &str = "lookups_without_site";

/// Of a part of photons: its paths, those among them that store nothing.
pub const PATHS_TRACED: &str = "paths_traced";
