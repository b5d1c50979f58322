//! How many rays were cast, and what became of them.

/// Rays that were cast.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Eye rays, with their reflections and refractions.
    pub eye: u64,
    /// Eye rays that a later pass over their pixel asks for again, whether they were remembered or not.
    pub eye_again: u64,
    /// Points seen where light is spread.
    pub seen: u64,
    /// Gather rays, not counting their reflections and refractions.
    pub gather: u64,
    /// Reflections and refractions of gather rays.
    pub gather_further: u64,
    /// Gather rays that left the scene or ended where there is nothing to ask for.
    pub gather_lost: u64,
    /// Gather rays that were too short and were continued.
    pub gather_continued: u64,
    /// Points seen whose gather rays were guided by photons.
    pub guided: u64,
}

impl std::ops::AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.eye += other.eye;
        self.eye_again += other.eye_again;
        self.seen += other.seen;
        self.gather += other.gather;
        self.gather_further += other.gather_further;
        self.gather_lost += other.gather_lost;
        self.gather_continued += other.gather_continued;
        self.guided += other.guided;
    }
}
