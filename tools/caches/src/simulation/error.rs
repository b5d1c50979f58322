//! Why caches cannot be simulated on a trace.

use pm_formats::trace::Region;
use thiserror::Error;

use crate::lines::MAX_LINES;
use crate::models::MAX_FRAMES;
use crate::{CacheConfig, ConfigError};

/// Why caches cannot be simulated on a trace.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SimulationError {
    /// The regions are too large to keep a table of their lines.
    #[error("the trace's regions have {lines} lines of {line_bytes} bytes; at most {MAX_LINES} can be simulated")]
    TooManyLines {
        /// Lines of all regions.
        lines: u64,
        /// The line size, in bytes.
        line_bytes: u32,
    },
    /// A region ends beyond the last address.
    #[error("region {region} of the trace ends beyond the last 64-bit address")]
    RegionBeyondAddresses {
        /// Index of the region.
        region: usize,
    },
    /// All addresses, and regions besides.
    #[error("the trace has a region of all addresses and others besides")]
    AddressesAndRegions,
    /// More regions than an access can name.
    #[error("the trace has {0} regions; at most 65536 can be told apart")]
    TooManyRegions(usize),
    /// A set-associative cache larger than the tables allow.
    #[error(
        "{0} has too many lines: at most {MAX_FRAMES} in sets, with ways rounded up to a power of two; full has no limit"
    )]
    TooManyFrames(CacheConfig),
    /// A cache of whose lines is not known when they leave.
    #[error("{0}: its policy does not tell when a line leaves; lru, fifo and the others of sets and ways do")]
    NoWriteBacks(CacheConfig),
    /// A cache behind none.
    #[error("{0}: without a cache there are no lines that one behind it could be asked for")]
    NoLines(CacheConfig),
    /// A curve of lines that will not do.
    #[error(transparent)]
    Line(#[from] ConfigError),
}

/// Refuses regions that cannot be told apart or do not lie in memory.
pub(super) fn check_regions(regions: &[Region]) -> Result<(), SimulationError> {
    if regions.len() > 1 << 16 {
        return Err(SimulationError::TooManyRegions(regions.len()));
    }
    if regions.len() > 1 && regions.iter().any(Region::is_addresses) {
        return Err(SimulationError::AddressesAndRegions);
    }
    match regions.iter().position(|r| r.size > 0 && r.base.checked_add(r.size - 1).is_none()) {
        Some(region) => Err(SimulationError::RegionBeyondAddresses { region }),
        None => Ok(()),
    }
}
