//! Simulated caches: what a trace of accesses costs in memory traffic.
//!
//! A [`Simulation`] listens to a trace and runs any number of [`CacheConfig`]s in one reading of it; each gets its
//! [`CacheCounts`], exact. How they count:
//!
//! * A **record** access is one access of the trace: one record, whole, wherever it lies. A **line access** is the part of
//!   it in one line. A record that spans two lines is two line accesses, each a hit or a miss of its own. A record of
//!   length zero (a trace of bare addresses) touches the line at its address.
//! * The **line number** is the byte address, region base plus offset, divided by the line size. Lines are attributed to
//!   the region of the access; should lines longer than a page make two regions share one, it is the same line to both.
//! * Every miss **fetches** the whole line, misses of writes too, also of a write that covers the line in full
//!   (write-allocate without a special case). A read-modify-write is one line access that reads and dirties.
//! * Caches are **write-back**: a line written while it is cached costs one write-back however often it is written, when it
//!   leaves, or at the end of the trace. It is charged when the line turns dirty, to the write that made it so, since
//!   leaving is then certain. Hence without warm-up the count is that of dirty evictions and of dirty lines left at the end.
//! * **Warm-up** blocks change what is cached and count nowhere: not their accesses, not their misses, not their writes.
//! * **Compulsory** fetches are lines touched for the first time in the whole trace, by an access that counts. A line
//!   first touched during warm-up is nobody's compulsory fetch.
//!
//! * Frames of a set are **filled** in order, from the lowest on, before any line is evicted.
//! * Belady's **optimum** minimises line accesses that miss, those of warm-up among them; with sets, of each set by itself.
//!   It does not minimise write-backs, which are counted for what it keeps.
//!
//! [`Prefetching`] brings in more than was missed. With [`Lanes`] in front, several searches are in flight at a time over the
//! same cache. [`Windows`] runs each window of a sampled trace through caches that begin empty, and estimates what the whole
//! would have cost.
//!
//! # To add a policy
//!
//! A policy is one file beside those in `policies`, and one line in [`policies()`]; from outside of the crate it is
//! `policies().with(&MyPolicy)`. In the file:
//!
//! * its state, as a [`Replacement`]: what it does when a line is used, when one comes in, and when a full set has to give
//!   one up. It sees every line access. Where a use of the line used last makes no difference it may say so
//!   ([`Replacement::REPEATS_MATTER`]), and is spared most of them;
//! * a [`Policy`] with its word, what is said of it, its model, and its definition: what it does in the plainest way there
//!   is, which the tests hold the model against. What is usual has defaults; a policy that cannot have any number of ways, or
//!   draws random numbers, or is no [`Replacement`] at all, says so there.
//!
//! That is all: it can be chosen (`64K,8,64,WORD`), it is in the help and in the errors of `pm-cachesim`, in the table of the
//! README (which a test holds to be this registry's), and in every test of [`trial`].

mod config;
mod curves;
mod findings;
mod lanes;
mod lines;
mod misses;
mod models;
#[cfg(test)]
mod plain_lru;
mod policies;
mod prefetch;
mod private;
mod simulation;
pub mod trial;
mod windows;

pub use config::{CacheConfig, ConfigError, SetIndex, UnknownWays, Ways};
pub use curves::{Curve, Estimate, LEAST_MODEL, SampledCurve};
pub use findings::{
    AskedCounts, CacheCounts, Distribution, Findings, Measures, RecordCounts, ResultMemory, SECTOR_BYTES, SpanRule,
    TraceCounts, WorkingSets,
};
pub use lanes::{LaneSink, LaneSource, Lanes};
pub use lines::{Attributes, LineChunk, LineSpace};
pub use misses::{BankMap, Dram, DramCounts, DramError, MissStream, MissStreamError, Misses, RowPolicy};
pub use models::{Answer, CacheModel, CacheOnTrace, LineCounts, Modelled, Replacement};
pub use policies::{ChosenPolicy, Policy, UnknownPolicy, WaysNeeded, policies};
pub use prefetch::{PrefetchCounts, PrefetchError, Prefetcher, Prefetching};
pub use private::{PrivateCaches, PrivateCounts};
pub use simulation::{Simulation, SimulationError};
pub use windows::{CountedWindows, WindowCounts, WindowError, WindowedCounts, Windows};
