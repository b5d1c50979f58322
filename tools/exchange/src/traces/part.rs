//! Which part of a trace is replayed.

/// Which of the accesses that are asked for are replayed, by their number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Part {
    /// So many are left out first.
    pub skip: u64,
    /// Then so many are simulated, but not counted.
    pub warm_up: u64,
    /// Then at most so many count; `None`: all.
    pub take: Option<u64>,
}

/// What becomes of an access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fate {
    LeftOut,
    Replayed,
    /// It is the first that counts.
    First,
    /// Nothing is read any more.
    Over,
}

impl Part {
    /// Whether it is all of the trace.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        *self == Self::default()
    }

    /// The fate of access number `number`, from 0 on.
    pub(super) fn fate(&self, number: u64) -> Fate {
        let Some(after) = number.checked_sub(self.skip) else { return Fate::LeftOut };
        match after.checked_sub(self.warm_up) {
            Some(counted) if self.take.is_some_and(|take| counted >= take) => Fate::Over,
            Some(0) if self.warm_up > 0 => Fate::First,
            _ => Fate::Replayed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_follow_one_another() {
        let fates = |part: Part| (0..6).map(|number| part.fate(number)).collect::<Vec<_>>();
        let (out, replayed, first, over) = (Fate::LeftOut, Fate::Replayed, Fate::First, Fate::Over);
        assert_eq!(fates(Part::default()), [replayed; 6]);
        let part = Part { skip: 1, warm_up: 2, take: Some(2) };
        assert_eq!(fates(part), [out, replayed, replayed, first, replayed, over]);
        assert_eq!(fates(Part { take: None, ..part }), [out, replayed, replayed, first, replayed, replayed]);
        assert_eq!(fates(Part { skip: 0, warm_up: 0, take: Some(0) }), [over; 6]);
        assert_eq!(fates(Part { skip: u64::MAX, warm_up: u64::MAX, take: Some(u64::MAX) }), [out; 6]);
    }
}
