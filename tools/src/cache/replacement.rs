//! Which line of a full set makes room.

/// A replacement policy over *frames*, the places for lines; set s owns frames s * ways to s * ways + ways - 1.
///
/// A frame is filled when a line enters an empty set place or takes a victim's; the cache asks for a victim only where
/// every frame of the set is filled.
pub(super) trait Replacement {
    /// The state for `frames` empty frames in sets of `ways`.
    fn new(frames: usize, ways: usize) -> Self;
    /// The line in `frame` is used again.
    fn hit(&mut self, frame: usize);
    /// A new line enters `frame`.
    fn fill(&mut self, frame: usize);
    /// Which frame of the full set that begins at `first` gives up its line.
    fn victim(&mut self, first: usize) -> usize;
}

/// Evicts the least recently used line of the set.
pub(super) struct Lru {
    last_use: Vec<u64>,
    now: u64,
    ways: usize,
}

impl Replacement for Lru {
    fn new(frames: usize, ways: usize) -> Self {
        Self { last_use: vec![0; frames], now: 0, ways }
    }

    #[inline]
    fn hit(&mut self, frame: usize) {
        self.last_use[frame] = self.now;
        self.now += 1;
    }

    #[inline]
    fn fill(&mut self, frame: usize) {
        self.hit(frame);
    }

    #[inline]
    fn victim(&mut self, first: usize) -> usize {
        let times = &self.last_use[first..first + self.ways];
        let (mut oldest, mut victim) = (times[0], 0);
        for (way, &time) in times.iter().enumerate() {
            // Selected, not branched on: which way is oldest is as good as random.
            victim = if time < oldest { way } else { victim };
            oldest = oldest.min(time);
        }
        first + victim
    }
}
