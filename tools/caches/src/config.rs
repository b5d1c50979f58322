//! What a cache is: its size, ways, line and policy, written `128K,full,128,lru`.

use std::{fmt, num::NonZeroU32, str::FromStr};

use thiserror::Error;

use super::policy::{Policy, UnknownPolicy};
use pm_size::{Bytes, SizeError};

/// Where a line may be placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ways {
    /// Anywhere: fully associative.
    Full,
    /// In any of this many places of its set.
    N(NonZeroU32),
}

/// Which set a line belongs to, where there are several: a number below a power of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SetIndex {
    /// The lowest bits of the line number.
    Plain,
    /// All bits of the line number, cut from below into pieces as long as a set number and combined by exclusive or, so
    /// that strides of a power of two do not meet in one set (after González, Valero, Topham and Parcerisa, *Eliminating
    /// Cache Conflict Misses Through XOR-Based Placement Functions*, ICS 1997).
    Hash,
}

/// One cache to simulate.
///
/// Read and printed as `SIZE,WAYS,LINE,POLICY`: `128K,full,128,lru`, `64K,8,64,plru`; with `,hash` behind it for a hashed
/// set index; or as `none` or `none,LINE` for no cache, where the line only says in what unit to count blocks and
/// compulsory fetches (128 if not given).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CacheConfig {
    size_bytes: u64,
    ways: Ways,
    line_bytes: u32,
    policy: Policy,
    index: SetIndex,
}

/// Line of a [`CacheConfig`] written `none`.
const DEFAULT_LINE: u32 = 128;

/// Smallest line, in bytes.
const MIN_LINE: u32 = 4;

/// Why there can be no such cache, and what would do.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ConfigError {
    /// Not four parts between commas, or five with `hash`.
    #[error(
        "`{0}`: a cache is SIZE,WAYS,LINE,POLICY such as 128K,full,128,lru or 64K,8,64,lru, and may end in ,hash; or none"
    )]
    Shape(String),
    /// The size or the line is not a byte size.
    #[error("`{text}`: {source}")]
    Size {
        /// What was written.
        text: String,
        /// What is wrong with the size.
        source: SizeError,
    },
    /// The ways are neither a number nor `full`.
    #[error("`{text}`: ways are `full` or a number from 1 on, not `{ways}`")]
    Ways {
        /// What was written.
        text: String,
        /// The ways as written.
        ways: String,
    },
    /// There is no such policy.
    #[error("`{text}`: {source}")]
    Policy {
        /// What was written.
        text: String,
        /// What policies there are.
        source: UnknownPolicy,
    },
    /// A tree over a number of ways that is no power of two.
    #[error("plru needs a power of two of ways, not {ways}; {nearest} would do")]
    Tree {
        /// The ways asked for; lines, where the cache is fully associative.
        ways: u64,
        /// The nearest number that would do.
        nearest: u64,
    },
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
        "{size} in {ways} ways of {line}-byte lines is {lines} lines, not a power of two of sets; \
         {nearest} in {ways} ways would do, or full"
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

impl CacheConfig {
    /// A cache of `size_bytes` bytes in lines of `line_bytes` bytes; `policy` is not [`Policy::None`].
    ///
    /// # Errors
    ///
    /// If the line is not a power of two of at least 4 bytes, the size not a whole number of at least one line, the
    /// number of sets (lines / ways) not a power of two, or the policy cannot have so many ways.
    pub fn new(size_bytes: u64, ways: Ways, line_bytes: u32, policy: Policy) -> Result<Self, ConfigError> {
        check_line(line_bytes.into())?;
        let line = u64::from(line_bytes);
        if size_bytes == 0 || !size_bytes.is_multiple_of(line) {
            let nearest = nearest(size_bytes, (size_bytes / line).max(1).checked_mul(line), {
                (size_bytes / line + 1).checked_mul(line)
            });
            return Err(ConfigError::NotLines { size: Bytes(size_bytes), line: line_bytes, nearest: Bytes(nearest) });
        }
        if let Ways::N(ways) = ways {
            let (ways, lines) = (u64::from(ways.get()), size_bytes / line);
            if !lines.is_multiple_of(ways) || !(lines / ways).is_power_of_two() {
                // Powers of two of sets on either side; a cache of fewer lines than ways has the lower one at 1 set.
                let below = 1 << (lines / ways).max(1).ilog2();
                let bytes = |sets: u64| sets.checked_mul(ways)?.checked_mul(line);
                let above = if lines < ways { bytes(1) } else { bytes(below * 2) };
                let nearest = nearest(size_bytes, bytes(below), above);
                let (size, ways) = (Bytes(size_bytes), ways as u32);
                return Err(ConfigError::Sets { size, ways, line: line_bytes, lines, nearest: Bytes(nearest) });
            }
        }
        let tree_ways = match ways {
            Ways::Full => size_bytes / line,
            Ways::N(ways) => ways.get().into(),
        };
        if policy == Policy::TreePlru && !tree_ways.is_power_of_two() {
            let below = 1_u64 << tree_ways.ilog2();
            let nearest = nearest(tree_ways, Some(below), below.checked_mul(2));
            return Err(ConfigError::Tree { ways: tree_ways, nearest });
        }
        Ok(Self { size_bytes, ways, line_bytes, policy, index: SetIndex::Plain })
    }

    /// A cache under LRU.
    ///
    /// # Errors
    ///
    /// As for [`new`](CacheConfig::new).
    pub fn lru(size_bytes: u64, ways: Ways, line_bytes: u32) -> Result<Self, ConfigError> {
        Self::new(size_bytes, ways, line_bytes, Policy::Lru)
    }

    /// The same cache with a hashed set index.
    ///
    /// # Errors
    ///
    /// If it is fully associative.
    pub fn hashed(self) -> Result<Self, ConfigError> {
        match self.ways {
            Ways::Full => Err(ConfigError::HashOfFull),
            Ways::N(_) => Ok(Self { index: SetIndex::Hash, ..self }),
        }
    }

    /// No cache; `line_bytes` is the unit of blocks and compulsory fetches.
    ///
    /// # Errors
    ///
    /// If the line is not a power of two of at least 4 bytes.
    pub fn none(line_bytes: u32) -> Result<Self, ConfigError> {
        check_line(line_bytes.into())?;
        Ok(Self { size_bytes: 0, ways: Ways::Full, line_bytes, policy: Policy::None, index: SetIndex::Plain })
    }

    /// The fully associative LRU cache of the same size and line, unless this is one or no cache.
    #[must_use]
    pub fn full_lru_twin(&self) -> Option<Self> {
        let twin = Self { ways: Ways::Full, policy: Policy::Lru, index: SetIndex::Plain, ..*self };
        (self.policy != Policy::None && *self != twin).then_some(twin)
    }

    /// Size in bytes; 0 where there is no cache.
    #[must_use]
    pub fn size_bytes(&self) -> u64 {
        self.size_bytes
    }

    /// Where a line may be placed.
    #[must_use]
    pub fn ways(&self) -> Ways {
        self.ways
    }

    /// Line in bytes, a power of two.
    #[must_use]
    pub fn line_bytes(&self) -> u32 {
        self.line_bytes
    }

    /// Which line makes room for a new one.
    #[must_use]
    pub fn policy(&self) -> Policy {
        self.policy
    }

    /// Which set a line belongs to.
    #[must_use]
    pub fn index(&self) -> SetIndex {
        self.index
    }

    /// How many sets it has, a power of two; 1 if it is fully associative, also by having as many ways as lines.
    #[must_use]
    pub fn sets(&self) -> u64 {
        match self.ways {
            Ways::Full => 1,
            Ways::N(ways) => self.lines() / u64::from(ways.get()),
        }
    }

    /// How many lines fit; 0 where there is no cache.
    #[must_use]
    pub fn lines(&self) -> u64 {
        self.size_bytes / u64::from(self.line_bytes)
    }
}

/// The line as its type, if it will do.
pub(super) fn check_line(line: u64) -> Result<u32, ConfigError> {
    match u32::try_from(line) {
        Ok(line) if line.is_power_of_two() && line >= MIN_LINE => Ok(line),
        Ok(short) => {
            let below = 1 << short.max(MIN_LINE).ilog2();
            let nearest = nearest(line, Some(below), (below < 1 << 31).then_some(below * 2));
            Err(ConfigError::Line { line, nearest: nearest as u32 })
        }
        Err(_) => Err(ConfigError::Line { line, nearest: 1 << 31 }),
    }
}

/// Whichever of two numbers exists and is nearer to `wanted`, the lower of equals.
fn nearest(wanted: u64, below: Option<u64>, above: Option<u64>) -> u64 {
    below.into_iter().chain(above).min_by_key(|n| n.abs_diff(wanted)).unwrap_or(wanted)
}

impl FromStr for CacheConfig {
    type Err = ConfigError;

    fn from_str(text: &str) -> Result<Self, ConfigError> {
        let bytes = |part: &str| match part.parse::<Bytes>() {
            Ok(bytes) => Ok(bytes.0),
            Err(source) => Err(ConfigError::Size { text: text.to_owned(), source }),
        };
        let cache = |size, ways, line, policy: &str| {
            let ways = match ways {
                "full" => Ways::Full,
                // `+8` is a number to Rust; to us it is a typing mistake.
                _ if !ways.bytes().all(|b| b.is_ascii_digit()) => return Err(bad_ways(text, ways)),
                number => Ways::N(number.parse().map_err(|_| bad_ways(text, ways))?),
            };
            let policy = policy.parse().map_err(|source| ConfigError::Policy { text: text.to_owned(), source })?;
            Self::new(bytes(size)?, ways, check_line(bytes(line)?)?, policy)
        };
        match text.split(',').collect::<Vec<_>>()[..] {
            ["none"] => Self::none(DEFAULT_LINE),
            ["none", line] => Self::none(check_line(bytes(line)?)?),
            [size, ways, line, policy] => cache(size, ways, line, policy),
            [size, ways, line, policy, "hash"] => cache(size, ways, line, policy)?.hashed(),
            _ => Err(ConfigError::Shape(text.to_owned())),
        }
    }
}

fn bad_ways(text: &str, ways: &str) -> ConfigError {
    ConfigError::Ways { text: text.to_owned(), ways: ways.to_owned() }
}

impl fmt::Display for Ways {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full => f.pad("full"),
            Self::N(n) => n.fmt(f),
        }
    }
}

impl fmt::Display for CacheConfig {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = Bytes(self.line_bytes.into());
        match self.policy {
            Policy::None => f.pad(&format!("none,{line}")),
            policy => {
                let hash = if self.index == SetIndex::Hash { ",hash" } else { "" };
                f.pad(&format!("{},{},{line},{policy}{hash}", Bytes(self.size_bytes), self.ways))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_printed_reads_back() {
        for (text, printed) in [
            ("128K,full,128,lru", "128K,full,128,lru"),
            ("131072,full,128,lru", "128K,full,128,lru"),
            ("64KiB,8,64B,lru", "64K,8,64,lru"),
            ("384,3,128,lru", "384,3,128,lru"),
            ("4K,1,4K,lru", "4K,1,4K,lru"),
            ("128K,8,128,lru,hash", "128K,8,128,lru,hash"),
            ("128K,full,128,fifo", "128K,full,128,fifo"),
            ("384,3,128,clock", "384,3,128,clock"),
            ("384,3,128,random", "384,3,128,random"),
            ("384,3,128,random:0", "384,3,128,random"),
            ("384,3,128,random:18446744073709551615,hash", "384,3,128,random:18446744073709551615,hash"),
            ("128K,full,128,plru", "128K,full,128,plru"),
            ("128K,full,128,min", "128K,full,128,min"),
            ("128K,4,128,min-bypass", "128K,4,128,min-bypass"),
            ("none", "none,128"),
            ("none,64", "none,64"),
        ] {
            let config: CacheConfig = text.parse().unwrap();
            assert_eq!(config.to_string(), printed);
            assert_eq!(printed.parse(), Ok(config));
        }
    }

    #[test]
    fn refusals_say_what_would_do() {
        for (text, hint) in [
            ("", "SIZE,WAYS,LINE,POLICY"),
            ("128K", "SIZE,WAYS,LINE,POLICY"),
            ("128K,full,128", "SIZE,WAYS,LINE,POLICY"),
            ("128K,full,128,lru,", "SIZE,WAYS,LINE,POLICY"),
            ("128KB,full,128,lru", "write 128K"),
            ("128K,8way,128,lru", "`full` or a number"),
            ("128K,0,128,lru", "`full` or a number"),
            ("128K,,128,lru", "`full` or a number"),
            ("128K,+8,128,lru", "`full` or a number"),
            ("128K,full,128,LUR", "there are lru, fifo, clock, random, random:SEED, plru, min, min-bypass, and none"),
            ("128K,full,128,none", "none for no cache"),
            ("128K,full,128,random:", "random:SEED"),
            ("128K,full,128,random:+1", "random:SEED"),
            ("128K,full,128,random:18446744073709551616", "random:SEED"),
            ("128K,8,128,lru,skew", "may end in ,hash"),
            ("128K,full,128,lru,hash", "leave out `,hash`"),
            ("384,3,128,plru", "not 3; 2 would do"),
            ("7K,7,128,plru", "not 7; 8 would do"),
            ("96K,full,128,plru", "not 768; 512 would do"),
            ("128K,full,100,lru", "128 would do"),
            ("128K,full,0,lru", "4 would do"),
            ("128K,full,2,lru", "4 would do"),
            ("128K,full,4G,lru", "2147483648 would do"),
            ("0,full,128,lru", "128 would do"),
            ("1000,full,128,lru", "1K would do"),
            ("96K,8,128,lru", "64K in 8 ways would do"),
            ("112K,8,128,lru", "128K in 8 ways would do"),
            ("128K,7,128,lru", "112K in 7 ways would do"),
            ("1K,16,128,lru", "2K in 16 ways would do"),
            ("16777215T,3,128,lru", "would do"),
            ("18446744073709551615,full,4,lru", "18446744073709551612 would do"),
        ] {
            let message = text.parse::<CacheConfig>().unwrap_err().to_string();
            assert!(message.contains(hint), "{text}: {message}");
        }
    }
}
