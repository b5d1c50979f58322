//! Lines by how recent they are: a list through a table of slots.

/// No slot.
const NONE: u32 = u32::MAX;

/// What is known of a line that is there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct State {
    /// It was prefetched, that counted, and nobody has asked for it yet.
    pub(super) awaited: bool,
    dirty: bool,
}

/// A line's neighbours in the list.
#[derive(Clone, Copy)]
struct Link {
    newer: u32,
    older: u32,
}

/// Lines of a fully associative cache, the most recent first.
pub(super) struct Recency {
    links: Vec<Link>,
    /// By slot, of those that are there.
    states: Vec<Option<State>>,
    newest: u32,
    oldest: u32,
    held: u64,
    room: u64,
}

impl Recency {
    /// For lines of so many slots, of which so many are there at a time, one at least.
    pub(super) fn new(slots: usize, room: u64) -> Self {
        let links = vec![Link { newer: NONE, older: NONE }; slots];
        Self { links, states: vec![None; slots], newest: NONE, oldest: NONE, held: 0, room }
    }

    /// What is known of a line, if it is there.
    #[inline]
    pub(super) fn state(&self, slot: u32) -> Option<State> {
        self.states[slot as usize]
    }

    /// A line comes in that is not there; the oldest makes room.
    pub(super) fn bring_in(&mut self, slot: u32, awaited: bool) {
        if self.held == self.room {
            let oldest = self.oldest;
            self.take_out(oldest);
            self.states[oldest as usize] = None;
            self.held -= 1;
        }
        self.held += 1;
        self.states[slot as usize] = Some(State { awaited, dirty: false });
        self.put_first(slot);
    }

    /// A line that is there is asked for.
    #[inline]
    pub(super) fn use_again(&mut self, slot: u32) {
        if let Some(state) = &mut self.states[slot as usize] {
            state.awaited = false;
        }
        if self.newest != slot {
            self.take_out(slot);
            self.put_first(slot);
        }
    }

    /// A line that is there is written: was it clean?
    pub(super) fn soil(&mut self, slot: u32) -> bool {
        self.states[slot as usize].as_mut().is_some_and(|state| !std::mem::replace(&mut state.dirty, true))
    }

    fn take_out(&mut self, slot: u32) {
        let Link { newer, older } = self.links[slot as usize];
        match newer {
            NONE => self.newest = older,
            _ => self.links[newer as usize].older = older,
        }
        match older {
            NONE => self.oldest = newer,
            _ => self.links[older as usize].newer = newer,
        }
    }

    fn put_first(&mut self, slot: u32) {
        self.links[slot as usize] = Link { newer: NONE, older: self.newest };
        match self.newest {
            NONE => self.oldest = slot,
            newest => self.links[newest as usize].newer = slot,
        }
        self.newest = slot;
    }
}
