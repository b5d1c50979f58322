//! Simulated caches: what a trace of accesses costs in memory traffic.
//!
//! A [`Simulation`] listens to a trace and runs any number of [`CacheConfig`]s in one reading of it; each becomes a
//! [`Row`] of exact counts. How they count:
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
//! With [`Lanes`] in front, several searches are in flight at a time over the same cache. [`Windows`] runs each window of a
//! sampled trace through caches that begin empty, and estimates what the whole would have cost.
//!
//! To add a policy of sets and ways, implement `Replacement`; for anything else, `CacheModel`. Either is one file, a name in
//! [`Policy`] and a line where a simulation makes its models.

mod config;
mod curve;
mod lanes;
mod lines;
mod lru_stack;
mod measures;
mod miss_stream;
mod misses;
mod model;
mod optimum;
mod policy;
mod records;
mod replacement;
mod results;
mod row;
mod set_associative;
mod shards;
mod simulation;
mod stack_distance;
mod uncached;
mod warmth;
mod windows;
mod working_set;

#[cfg(test)]
mod curve_tests;
#[cfg(test)]
mod measure_tests;
#[cfg(test)]
mod shards_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod windows_tests;

pub use config::{CacheConfig, ConfigError, SetIndex, Ways};
pub use curve::{Curve, TraceCounts};
pub use lanes::{LaneSource, Lanes};
pub use measures::{Findings, Measures, Span};
pub use miss_stream::{MissStream, MissStreamError};
pub use policy::{Policy, UnknownPolicy};
pub use results::{ResultMemory, SECTOR_BYTES};
pub use row::{More, RecordCounts, Row};
pub use shards::{Estimate, LEAST_MODEL, SampledCurve};
pub use simulation::{Simulation, SimulationError};
pub use windows::{Counts, WindowError, WindowedRow, Windows};
pub use working_set::{Distribution, WorkingSets};
