//! Frames of a single set of any number of ways: how many were freed at each time, in a window of times.

use super::{Bypass, Found, Frames};
use crate::lines::{LineSpace, grow};

/// Times are numbered anew whenever the window is full: what matters of a time is only which frames were free then, so
/// afterwards there are as many as frames freed at different times.
///
/// To find the last time before another at which a frame was freed that still is free, each time at which none is points to
/// an earlier one (union and find, with the paths halved as they are walked): a few steps, as times only ever lose frames,
/// except for now.
pub(crate) struct OneSet {
    bypass: Bypass,
    /// The least number of times.
    window: usize,
    /// Frames that stays can have.
    free: usize,
    /// By slot, since when the stay that began with the last use needs a frame.
    starts: Vec<u32>,
    /// What time it is, an index into the window.
    now: u32,
    /// How many of the frames free now were freed at each time.
    freed: Vec<u32>,
    /// Of each time before now, itself if frames were freed then that are free, else an earlier time.
    earlier: Vec<u32>,
}

/// A line not yet used.
const NEVER: u32 = 0;
/// A line last used when there was no frame for it; there will be none. Also what a search for a frame ends with.
const GONE: u32 = 1;
/// When all frames are free and none was used.
const FIRST: u32 = 2;

/// Times that are worth a window, where that is more than half of the lines.
const WINDOW: usize = 1 << 16;

impl OneSet {
    /// A cache of `ways` lines, in a trace of the lines of `space`.
    pub(crate) fn new(space: &LineSpace, ways: usize, bypass: Bypass) -> Self {
        Self::with_window(space.slots() as usize, space.most_slots() as usize, ways, bypass, WINDOW)
    }

    fn with_window(slots: usize, most_slots: usize, ways: usize, bypass: Bypass, window: usize) -> Self {
        // There is never more than one stay of each line.
        let free = bypass.free(ways).min(most_slots);
        let mut frames = Self { bypass, window, free, starts: vec![], now: FIRST, freed: vec![], earlier: vec![] };
        frames.starts.resize(slots, NEVER);
        frames.make_times(slots);
        frames.freed[FIRST as usize] = free as u32;
        frames.earlier[NEVER as usize] = NEVER;
        frames
    }

    /// As many times as so many lines need.
    fn make_times(&mut self, slots: usize) {
        // Numbering anew looks at all lines and all times, and leaves at least a third of the times for misses until the
        // next: little for each of them. The numbers fit 32 bits for all the lines a simulation takes, 2^31.
        let free = self.free.min(slots);
        let times = self.window.max(slots / 2).max(free + free / 2) + FIRST as usize + 2;
        if self.freed.len() < times {
            self.freed.resize(times, 0);
            self.earlier.resize(times, GONE);
        }
    }

    /// The last time not after `time`, which is before now, at which a frame was freed that is free; [`GONE`] or before if
    /// there is none.
    #[inline]
    fn last_freed(&mut self, mut time: u32) -> u32 {
        loop {
            let to = self.earlier[time as usize];
            if to == time {
                return time;
            }
            let beyond = self.earlier[to as usize];
            self.earlier[time as usize] = beyond;
            time = beyond;
        }
    }

    /// A new time begins.
    #[inline]
    fn pass_time(&mut self) {
        let now = self.now as usize;
        // The time before may point further back already, but searches from here will shorten the way.
        self.earlier[now] = if self.freed[now] > 0 { self.now } else { self.now - 1 };
        self.now += 1;
        self.freed[now + 1] = 0;
        if now + 2 == self.freed.len() {
            self.renumber();
        }
    }

    /// Numbers times anew, leaving out those at which no frame was freed that is free.
    #[cold]
    fn renumber(&mut self) {
        let mut kept = GONE;
        for time in FIRST..self.now {
            let freed = self.freed[time as usize];
            if freed > 0 {
                kept += 1;
                self.freed[kept as usize] = freed;
            }
            self.earlier[time as usize] = kept;
        }
        kept += 1;
        self.freed[kept as usize] = self.freed[self.now as usize];
        self.earlier[self.now as usize] = kept;
        self.now = kept;
        for start in &mut self.starts {
            *start = self.earlier[*start as usize];
        }
        (FIRST..self.now).for_each(|time| self.earlier[time as usize] = time);
    }
}

impl Frames for OneSet {
    #[inline]
    fn touch(&mut self, slot: u32, _: impl FnOnce() -> u64) -> Found {
        let start = self.starts[slot as usize];
        if start == self.now {
            return Found::Kept;
        }
        let freed = self.last_freed(start);
        if freed > GONE {
            self.freed[freed as usize] -= 1;
            if self.freed[freed as usize] == 0 {
                self.earlier[freed as usize] = freed - 1;
            }
            self.freed[self.now as usize] += 1;
            self.starts[slot as usize] = self.now;
            return Found::Kept;
        }
        self.pass_time();
        self.starts[slot as usize] = self.now - u32::from(self.bypass.earlier());
        if start == NEVER { Found::New } else { Found::Gone }
    }

    fn grow(&mut self, space: &LineSpace) {
        grow(&mut self.starts, space, NEVER);
        self.make_times(self.starts.len());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which of pseudo-random accesses to 60 lines are found, in caches of 1, 4 and 30 lines.
    fn found(window: usize) -> Vec<bool> {
        let mut found = Vec::new();
        for (ways, bypass) in [(1, Bypass::Never), (4, Bypass::Never), (30, Bypass::Never), (4, Bypass::Allowed)] {
            let mut frames = OneSet::with_window(60, 60, ways, bypass, window);
            let mut state = 1_u32;
            for round in 0..20_000 {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let slot = (state >> 16) % if round % 500 < 250 { 60 } else { 6 };
                found.push(frames.touch(slot, || 0) == Found::Kept);
            }
        }
        found
    }

    #[test]
    fn numbering_times_anew_makes_no_difference() {
        let expected = found(1 << 20);
        for window in [1, 37, 64, 1000] {
            assert!(found(window) == expected, "window {window}");
        }
    }

    #[test]
    fn the_window_does_not_grow_with_the_cache() {
        let frames = OneSet::with_window(10, 10, usize::MAX, Bypass::Never, WINDOW);
        assert!(frames.freed.len() < 2 * WINDOW);
    }
}
