//! What a cache is: its size, ways, line and policy, written `128K,full,128,lru`.

mod error;
mod limits;
#[cfg(test)]
mod tests;
mod text;
mod ways;

pub use error::ConfigError;
pub(crate) use limits::{check_line, nearest};
pub use ways::{SetIndex, UnknownWays, Ways};

use crate::policies::{ChosenPolicy, Lru, NoCache, Policy};
use limits::{check_lines, check_sets};

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
    policy: ChosenPolicy,
    index: SetIndex,
}

/// The policy that others are compared with.
const LRU: &dyn Policy = &Lru;

impl CacheConfig {
    /// A cache of `size_bytes` bytes in lines of `line_bytes` bytes; `policy` keeps lines.
    ///
    /// # Errors
    ///
    /// If the line is not a power of two of at least 4 bytes, the size not a whole number of at least one line, the
    /// number of sets (lines / ways) not a power of two, or the policy cannot have so many ways.
    pub fn new(
        size_bytes: u64,
        ways: Ways,
        line_bytes: u32,
        policy: impl Into<ChosenPolicy>,
    ) -> Result<Self, ConfigError> {
        let policy = policy.into();
        if !policy.entry().keeps_lines() {
            return Err(ConfigError::KeepsNothing(policy));
        }
        check_line(line_bytes.into())?;
        check_lines(size_bytes, line_bytes)?;
        check_sets(size_bytes, ways, line_bytes, SetIndex::Plain)?;
        let lines_of_set = match ways {
            Ways::Full => size_bytes / u64::from(line_bytes),
            Ways::N(ways) => ways.get().into(),
        };
        let allowed = policy.entry().allows_ways(lines_of_set);
        allowed.map_err(|needed| ConfigError::PolicyWays { policy, ways: lines_of_set, needed })?;
        Ok(Self { size_bytes, ways, line_bytes, policy, index: SetIndex::Plain })
    }

    /// A cache under LRU.
    ///
    /// # Errors
    ///
    /// As for [`new`](CacheConfig::new).
    pub fn lru(size_bytes: u64, ways: Ways, line_bytes: u32) -> Result<Self, ConfigError> {
        Self::new(size_bytes, ways, line_bytes, LRU)
    }

    /// The same cache with a hashed set index.
    ///
    /// # Errors
    ///
    /// If it is fully associative, or its sets are not a power of two.
    pub fn hashed(self) -> Result<Self, ConfigError> {
        match self.ways {
            Ways::Full => Err(ConfigError::HashOfFull),
            Ways::N(_) => {
                check_sets(self.size_bytes, self.ways, self.line_bytes, SetIndex::Hash)?;
                Ok(Self { index: SetIndex::Hash, ..self })
            }
        }
    }

    /// No cache; `line_bytes` is the unit of blocks and compulsory fetches.
    ///
    /// # Errors
    ///
    /// If the line is not a power of two of at least 4 bytes.
    pub fn none(line_bytes: u32) -> Result<Self, ConfigError> {
        Self::without(ChosenPolicy::new(&NoCache), line_bytes)
    }

    /// A line of so many bytes, if it will do.
    ///
    /// # Errors
    ///
    /// If it is not a power of two of at least 4 bytes.
    pub fn line(bytes: u64) -> Result<u32, ConfigError> {
        check_line(bytes)
    }

    /// No cache, by a policy that keeps no lines.
    fn without(policy: ChosenPolicy, line_bytes: u32) -> Result<Self, ConfigError> {
        check_line(line_bytes.into())?;
        Ok(Self { size_bytes: 0, ways: Ways::Full, line_bytes, policy, index: SetIndex::Plain })
    }

    /// The fully associative LRU cache of the same size and line, unless this is one or no cache.
    #[must_use]
    pub fn full_lru_twin(&self) -> Option<Self> {
        let twin = Self { ways: Ways::Full, policy: LRU.into(), index: SetIndex::Plain, ..*self };
        (self.keeps_lines() && *self != twin).then_some(twin)
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
    pub fn policy(&self) -> ChosenPolicy {
        self.policy
    }

    /// Whether there is a cache: where there is none, records go to memory by themselves.
    #[must_use]
    pub fn keeps_lines(&self) -> bool {
        self.policy.entry().keeps_lines()
    }

    /// Which set a line belongs to.
    #[must_use]
    pub fn index(&self) -> SetIndex {
        self.index
    }

    /// How many sets it has; 1 if it is fully associative, also by having as many ways as lines.
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
