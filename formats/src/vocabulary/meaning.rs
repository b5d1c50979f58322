//! Names under which a header says what its records mean ([`Header::meaning`](crate::Header::meaning)).

/// The scene that photons or queries are of: a digest of its geometry, materials and lights.
pub const SCENE: &str = "scene";
/// The order in which the queries were made: an [`OrderLabel`](super::OrderLabel).
pub const ORDER: &str = "order";
/// The order that they were put into afterwards: a [`DeferredLabel`](super::DeferredLabel).
pub const DEFERRED_ORDER: &str = "deferred order";
/// Samples of a pixel, where there is more than one: a number.
pub const SAMPLES: &str = "samples";
/// Gather rays of a point seen: a number, or why there are none.
pub const GATHERS: &str = "gathers";
/// Irradiance is cached: the error that is allowed, a number.
pub const IRRADIANCE_CACHE: &str = "irradiance cache";
/// How gather rays are spread, where that is not the usual: a word.
pub const SAMPLING: &str = "sampling";
/// What gather rays do at mirrors and glass, where they do not go on: a word.
pub const AT_SPECULAR: &str = "at specular";
/// Queries that wait for the end of their batch: which, in words.
pub const QUEUED: &str = "queued";
/// The photons that guide the gather rays: number and digest.
pub const GUIDE: &str = "guide";
/// Which photons they are, where they are not all: a word.
pub const PHOTONS: &str = "photons";
/// What [`PHOTONS`] says where all came from a light by mirrors and glass alone.
pub const CAUSTICS: &str = "caustics";
/// The photon map that was searched: its word.
pub const MAP: &str = "map";
/// Photons of a search: a number.
pub const K: &str = "k";
/// Irradiance was computed at some photons before: where, in words.
pub const PRECOMPUTED: &str = "precomputed";
/// The stream is one of several parts that several machines make: a [`Part`](super::Part).
pub const PART: &str = "part";
/// The stream is a part of a whole: which, in words.
pub const SAMPLE: &str = "sample";
/// What the part was chosen of: a [`SampleUnit`](super::SampleUnit).
pub const SAMPLE_OF: &str = "sample of";
/// Each batch of the stream is a window that stands for itself: how many were chosen, 0 if the end only will show.
pub const SAMPLE_WINDOWS: &str = "sample windows";
/// The share of the whole that those windows measure: a number above 0, at most 1.
pub const SAMPLE_SHARE: &str = "sample share";
/// The accesses are the misses of these caches, first to last.
pub const MISSES_OF: &str = "misses of";
