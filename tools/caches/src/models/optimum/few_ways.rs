//! Frames of many sets: by set, a sorted list of when they were freed.

use super::{super::Sets, Bypass, Found, Frames};
use crate::lines::{LineSpace, grow};

/// Times are counted by set, from [`FIRST`] on: 64 bits never run out.
pub(crate) struct FewWays {
    sets: Sets,
    bypass: Bypass,
    /// By slot, since when the stay that began with the last use needs a frame.
    starts: Vec<u64>,
    /// By set, what time it is.
    now: Vec<u64>,
    /// Frames that stays can have, in each set.
    ways: usize,
    /// By set, since when its frames are free, ascending.
    free: Vec<u64>,
}

/// A line not yet used: before all times.
const NEVER: u64 = 0;
/// When all frames are free and none was used.
const FIRST: u64 = 1;

/// The most ways in which it is faster to count all than to search.
const COUNTED: usize = 32;

impl FewWays {
    pub(crate) fn new(slots: usize, sets: Sets, ways: usize, bypass: Bypass) -> Self {
        let ways = bypass.free(ways);
        Self {
            sets,
            bypass,
            starts: vec![NEVER; slots],
            now: vec![FIRST; sets.number()],
            ways,
            free: vec![FIRST; sets.number() * ways],
        }
    }
}

impl Frames for FewWays {
    #[inline]
    fn touch(&mut self, slot: u32, line: impl FnOnce() -> u64) -> Found {
        let set = self.sets.of(line());
        let (start, now) = (&mut self.starts[slot as usize], &mut self.now[set]);
        if *start == *now {
            return Found::Kept;
        }
        let free = &mut self.free[set * self.ways..][..self.ways];
        // How many were free when the stay began; of these, the last is the one freed last.
        let before = if free.len() <= COUNTED {
            free.iter().map(|&since| usize::from(since <= *start)).sum()
        } else {
            free.partition_point(|&since| since <= *start)
        };
        if before > 0 {
            // A short list is moved in place, a long one as a block of memory.
            if free.len() <= COUNTED {
                (before..free.len()).for_each(|i| free[i - 1] = free[i]);
            } else {
                free.copy_within(before.., before - 1);
            }
            free[self.ways - 1] = *now;
            *start = *now;
            return Found::Kept;
        }
        let found = if *start == NEVER { Found::New } else { Found::Gone };
        *now += 1;
        *start = *now - u64::from(self.bypass.earlier());
        found
    }

    fn grow(&mut self, space: &LineSpace) {
        grow(&mut self.starts, space, NEVER);
    }
}
