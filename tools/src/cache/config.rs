//! What a cache is: its size, ways, line and policy, written `128K,full,128,lru`.

use std::{fmt, num::NonZeroU32, str::FromStr};

use thiserror::Error;

use crate::size::{Bytes, SizeError};

/// Where a line may be placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ways {
    /// Anywhere: fully associative.
    Full,
    /// In any of this many places of its set.
    N(NonZeroU32),
}

/// Which line makes room for a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Policy {
    /// No cache at all: every record goes to memory by itself, byte for byte.
    None,
    /// The least recently used.
    Lru,
}

/// One cache to simulate.
///
/// Read and printed as `SIZE,WAYS,LINE,POLICY`: `128K,full,128,lru`, `64K,8,64,lru`; or as `none` or `none,LINE` for no
/// cache, where the line only says in what unit to count blocks and compulsory fetches (128 if not given).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CacheConfig {
    size_bytes: u64,
    ways: Ways,
    line_bytes: u32,
    policy: Policy,
}

/// Line of a [`CacheConfig`] written `none`.
const DEFAULT_LINE: u32 = 128;

/// Smallest line, in bytes.
const MIN_LINE: u32 = 4;

/// Why there can be no such cache, and what would do.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ConfigError {
    /// Not four parts between commas.
    #[error("`{0}`: a cache is SIZE,WAYS,LINE,POLICY such as 128K,full,128,lru or 64K,8,64,lru; or none")]
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
    #[error("`{text}`: there is no policy `{policy}`; there is lru, and none for no cache")]
    Policy {
        /// What was written.
        text: String,
        /// The policy as written.
        policy: String,
    },
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
    /// A cache of `size_bytes` bytes in lines of `line_bytes` bytes.
    ///
    /// # Errors
    ///
    /// If the line is not a power of two of at least 4 bytes, the size not a whole number of at least one line, or the
    /// number of sets (lines / ways) not a power of two.
    pub fn lru(size_bytes: u64, ways: Ways, line_bytes: u32) -> Result<Self, ConfigError> {
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
        Ok(Self { size_bytes, ways, line_bytes, policy: Policy::Lru })
    }

    /// No cache; `line_bytes` is the unit of blocks and compulsory fetches.
    ///
    /// # Errors
    ///
    /// If the line is not a power of two of at least 4 bytes.
    pub fn none(line_bytes: u32) -> Result<Self, ConfigError> {
        check_line(line_bytes.into())?;
        Ok(Self { size_bytes: 0, ways: Ways::Full, line_bytes, policy: Policy::None })
    }

    /// The fully associative LRU cache of the same size and line, unless this is one or no cache.
    #[must_use]
    pub fn full_lru_twin(&self) -> Option<Self> {
        let twin = Self { ways: Ways::Full, policy: Policy::Lru, ..*self };
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
        match text.split(',').collect::<Vec<_>>()[..] {
            ["none"] => Self::none(DEFAULT_LINE),
            ["none", line] => Self::none(check_line(bytes(line)?)?),
            [size, ways, line, policy] => {
                let ways = match ways {
                    "full" => Ways::Full,
                    // `+8` is a number to Rust; to us it is a typing mistake.
                    _ if !ways.bytes().all(|b| b.is_ascii_digit()) => return Err(bad_ways(text, ways)),
                    number => Ways::N(number.parse().map_err(|_| bad_ways(text, ways))?),
                };
                if policy != "lru" {
                    return Err(ConfigError::Policy { text: text.to_owned(), policy: policy.to_owned() });
                }
                Self::lru(bytes(size)?, ways, check_line(bytes(line)?)?)
            }
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

impl fmt::Display for Policy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::None => "none",
            Self::Lru => "lru",
        })
    }
}

impl fmt::Display for CacheConfig {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = Bytes(self.line_bytes.into());
        match self.policy {
            Policy::None => f.pad(&format!("none,{line}")),
            policy => f.pad(&format!("{},{},{line},{policy}", Bytes(self.size_bytes), self.ways)),
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
            ("128K,full,128,LUR", "there is lru"),
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
