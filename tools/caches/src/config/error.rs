//! Why there can be no such cache, and what would do.

use pm_size::{Bytes, SizeError};
use thiserror::Error;

use super::ways::UnknownWays;
use crate::{ChosenPolicy, UnknownPolicy, WaysNeeded};

/// Why there can be no such cache, and what would do.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ConfigError {
    /// Not four parts between commas, or five with `hash`.
    #[error(
        "`{0}`: a cache is SIZE,WAYS,LINE,POLICY such as 128K,full,128,lru or 64K,8,64,lru, and may end in ,hash; or none"
    )]
    Parts(String),
    /// The size or the line is not a byte size.
    #[error("`{text}`: {source}")]
    Size {
        /// What was written.
        text: String,
        /// What is wrong with the size.
        source: SizeError,
    },
    /// The ways are neither a number nor `full`.
    #[error("`{text}`: {source}")]
    Ways {
        /// What was written.
        text: String,
        /// What is wrong with the ways.
        source: UnknownWays,
    },
    /// There is no such policy.
    #[error("`{text}`: {source}")]
    Policy {
        /// What was written.
        text: String,
        /// What policies there are.
        source: UnknownPolicy,
    },
    /// The policy cannot have so many ways.
    #[error("{policy} needs {}, not {ways}; {} would do", needed.what, needed.nearest)]
    PolicyWays {
        /// The policy.
        policy: ChosenPolicy,
        /// The ways asked for; lines, where the cache is fully associative.
        ways: u64,
        /// What it needs, and the nearest number that would do.
        needed: WaysNeeded,
    },
    /// A policy that keeps no lines, with a size and ways.
    #[error("`{0}` is no cache: it has a line, but no size and no ways")]
    KeepsNothing(ChosenPolicy),
    /// A set index where there are no sets to choose from.
    #[error("a fully associative cache has no set index to hash: leave out `,hash`, or give a number of ways")]
    HashOfFull,
    /// The line is too short, too long, or no power of two.
    #[error("a line of {line} bytes will not do: it must be a power of two from 4 to 2147483648; {nearest} would do")]
    Line {
        /// The line asked for, in bytes.
        line: u64,
        /// The nearest line that would do, in bytes.
        nearest: u32,
    },
    /// The size is not a whole number of lines.
    #[error("{size} is not a whole number of lines of {line} bytes; {nearest} would do")]
    NotLines {
        /// The size asked for.
        size: Bytes,
        /// The line, in bytes.
        line: u32,
        /// The nearest size that would do.
        nearest: Bytes,
    },
    /// The lines do not fill sets of so many ways, or sets of a number that is no power of two.
    #[error(
        "{size} in {ways} ways of {line}-byte lines is {lines} lines, no whole number of sets (or under ,hash no \
         power of two of them); {nearest} in {ways} ways would do, or full"
    )]
    Sets {
        /// The size asked for.
        size: Bytes,
        /// The ways asked for.
        ways: u32,
        /// The line, in bytes.
        line: u32,
        /// Lines of that size.
        lines: u64,
        /// The nearest size that would do with these ways and lines.
        nearest: Bytes,
    },
}
