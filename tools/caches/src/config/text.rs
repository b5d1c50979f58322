//! Caches as they are written: `64K,8,64,lru,hash`, `none`.

use std::{fmt, str::FromStr};

use pm_registry::Registry;
use pm_size::Bytes;

use super::{CacheConfig, ConfigError, SetIndex, check_line};
use crate::{ChosenPolicy, Policy, policies};

/// Line of a cache written `none`.
const DEFAULT_LINE: u32 = 128;

impl CacheConfig {
    /// Reads a cache under one of `policies`.
    ///
    /// # Errors
    ///
    /// If it is not written as a cache is, or as [`new`](Self::new).
    pub fn parse(text: &str, policies: &Registry<dyn Policy>) -> Result<Self, ConfigError> {
        let bytes = |part: &str| match part.parse::<Bytes>() {
            Ok(bytes) => Ok(bytes.0),
            Err(source) => Err(ConfigError::Size { text: text.to_owned(), source }),
        };
        let line = |part: &str| check_line(bytes(part)?);
        let cache = |size, ways: &str, line_bytes, policy: &str| {
            let ways = ways.parse().map_err(|source| ConfigError::Ways { text: text.to_owned(), source })?;
            let policy = ChosenPolicy::parse(policy, policies)
                .map_err(|source| ConfigError::Policy { text: text.to_owned(), source })?;
            Self::new(bytes(size)?, ways, line(line_bytes)?, policy)
        };
        let not_a_cache = || ConfigError::Parts(text.to_owned());
        let without = |policy: &str| {
            let entry = policies.find(policy).ok().filter(|entry| !entry.keeps_lines());
            entry.map(ChosenPolicy::new).ok_or_else(not_a_cache)
        };
        match text.split(',').collect::<Vec<_>>()[..] {
            [policy] => Self::without(without(policy)?, DEFAULT_LINE),
            [policy, line_bytes] => Self::without(without(policy)?, line(line_bytes)?),
            [size, ways, line_bytes, policy] => cache(size, ways, line_bytes, policy),
            [size, ways, line_bytes, policy, "hash"] => cache(size, ways, line_bytes, policy)?.hashed(),
            _ => Err(not_a_cache()),
        }
    }
}

impl FromStr for CacheConfig {
    type Err = ConfigError;

    /// A cache under one of the [`policies`].
    fn from_str(text: &str) -> Result<Self, ConfigError> {
        Self::parse(text, &policies())
    }
}

impl fmt::Display for CacheConfig {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (line, policy) = (Bytes(self.line_bytes.into()), self.policy);
        if !self.keeps_lines() {
            return f.pad(&format!("{policy},{line}"));
        }
        let hash = if self.index == SetIndex::Hash { ",hash" } else { "" };
        f.pad(&format!("{},{},{line},{policy}{hash}", Bytes(self.size_bytes), self.ways))
    }
}
