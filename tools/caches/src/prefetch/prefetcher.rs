//! Which lines a miss brings in besides its own.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use pm_size::Bytes;
use thiserror::Error;

use crate::{CacheConfig, SimulationError, Ways};

/// Which lines a miss brings in besides its own; written `next-line:1`, `treelet:512`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prefetcher {
    /// So many of those behind it.
    NextLine(u32),
    /// The others of its block of so many bytes, of those into which its region is cut.
    Treelet(u32),
}

/// Why nothing is prefetched.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PrefetchError {
    /// It is none.
    #[error(
        "{0}: `next-line:N` for the N lines behind a miss or `treelet:BYTES` for its block is expected, such as treelet:512"
    )]
    Unknown(String),
    /// Another cache than those that it is made for.
    #[error("{0}: a prefetcher brings lines into fully associative LRU caches; give SIZE,full,LINE,lru")]
    Cache(CacheConfig),
    /// A treelet that is no more than a line.
    #[error("{0}: such a treelet is not two or more whole lines of {1}")]
    Treelet(Prefetcher, CacheConfig),
    /// A miss that brings in more than there is room for.
    #[error("{0}: what one miss brings in does not fit in {1}")]
    TooMuch(Prefetcher, CacheConfig),
    /// Nobody knows where a block begins.
    #[error("a trace of all addresses has no regions that lines could be prefetched of")]
    NoRegions,
    /// Misses of records and not of lines.
    #[error("a prefetcher brings in lines: leave out --span once")]
    Records,
    /// The caches cannot be simulated at all.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

impl Prefetcher {
    /// Lines that a miss brings in, its own among them, of lines of so many bytes.
    fn together(self, line_bytes: u32) -> u64 {
        match self {
            Self::NextLine(lines) => u64::from(lines) + 1,
            Self::Treelet(bytes) => u64::from(bytes / line_bytes),
        }
    }

    /// Refuses what cannot be done with this cache, or does nothing.
    pub(super) fn check(self, config: &CacheConfig) -> Result<(), PrefetchError> {
        if !config.keeps_lines() || config.ways() != Ways::Full || config.full_lru_twin().is_some() {
            return Err(PrefetchError::Cache(*config));
        }
        let line = config.line_bytes();
        if matches!(self, Self::Treelet(bytes) if bytes % line != 0 || bytes < 2 * line) {
            return Err(PrefetchError::Treelet(self, *config));
        }
        match self.together(line) > config.lines() {
            true => Err(PrefetchError::TooMuch(self, *config)),
            false => Ok(()),
        }
    }

    /// The lines that a miss brings in, in this order, its own perhaps among them. Lines of its region are those from the first
    /// of `ends` to the last.
    #[inline]
    pub(super) fn lines(self, missed: u32, (first, last): (u32, u32), line_bytes: u32) -> RangeInclusive<u32> {
        match self {
            Self::NextLine(lines) => missed + 1..=last.min(missed.saturating_add(lines)),
            Self::Treelet(bytes) => {
                let lines = bytes / line_bytes;
                let from = first + (missed - first) / lines * lines;
                from..=last.min(from.saturating_add(lines - 1))
            }
        }
    }
}

impl FromStr for Prefetcher {
    type Err = PrefetchError;

    fn from_str(text: &str) -> Result<Self, PrefetchError> {
        let unknown = || PrefetchError::Unknown(text.to_owned());
        match text.split_once(':').ok_or_else(unknown)? {
            ("next-line", lines) => match lines.parse() {
                Ok(lines) if lines > 0 => Ok(Self::NextLine(lines)),
                _ => Err(unknown()),
            },
            ("treelet", bytes) => {
                let bytes = bytes.parse().map(|Bytes(bytes)| bytes).map_err(|_| unknown())?;
                u32::try_from(bytes).map(Self::Treelet).map_err(|_| unknown())
            }
            _ => Err(unknown()),
        }
    }
}

impl fmt::Display for Prefetcher {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NextLine(lines) => write!(f, "next-line:{lines}"),
            Self::Treelet(bytes) => write!(f, "treelet:{}", Bytes(bytes.into())),
        }
    }
}
