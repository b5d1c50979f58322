//! Lanes that each have a part of the batch of their own.

use std::io;

use pm_formats::trace::Access;
use pm_spool::{Cursor, Event, Spool};

use super::{LaneSink, Listener, Origin};

/// The batch in hand, and where each search begins in it.
pub(super) struct Parts {
    spool: Spool,
    starts: Vec<u64>,
}

impl Parts {
    pub(super) fn new() -> io::Result<Self> {
        Ok(Self { spool: Spool::new()?, starts: vec![] })
    }

    /// A search comes in.
    pub(super) fn begin(&mut self, origin: Origin, destinations: &[u32]) -> io::Result<()> {
        self.starts.push(self.spool.mark());
        self.spool.search(origin.warm_up, destinations)
    }

    /// An access of it.
    #[inline]
    pub(super) fn access(&mut self, access: Access) -> io::Result<()> {
        assert!(!self.starts.is_empty(), "a search has begun");
        self.spool.access(access)
    }

    /// It is whole.
    pub(super) fn end(&mut self) -> io::Result<()> {
        self.spool.search_end()
    }

    /// Lets the batch fly, in as many parts as there are lanes, and forgets it.
    pub(super) fn play<S: LaneSink>(
        &mut self,
        lanes: usize,
        origin: Origin,
        listener: &mut Listener<S>,
    ) -> io::Result<()> {
        let searches = self.starts.len();
        if searches == 0 {
            return Ok(());
        }
        self.starts.push(self.spool.mark());
        self.spool.flush()?;
        let first = |part: usize| self.starts[(part as u128 * searches as u128 / lanes as u128) as usize];
        let part = |lane| Some((self.spool.cursor(first(lane), first(lane + 1)), origin));
        fly((0..lanes).map(part).collect(), listener)?;
        self.starts.clear();
        self.spool.clear()
    }
}

/// All lanes in turn, each a stretch of what waits, until none has anything left.
pub(super) fn fly<S: LaneSink>(
    mut lanes: Vec<Option<(Cursor<'_>, Origin)>>,
    listener: &mut Listener<S>,
) -> io::Result<()> {
    while lanes.iter().any(Option::is_some) {
        for (number, lane) in lanes.iter_mut().enumerate() {
            let Some((cursor, origin)) = lane else { continue };
            if !turn(number, cursor, origin, listener)? {
                *lane = None;
            }
        }
    }
    Ok(())
}

/// One access of a lane; false if it has none left.
fn turn<S: LaneSink>(
    lane: usize,
    cursor: &mut Cursor,
    origin: &mut Origin,
    listener: &mut Listener<S>,
) -> io::Result<bool> {
    while let Some(event) = cursor.next_event()? {
        match event {
            Event::Search { warm_up, destinations } => {
                origin.warm_up = warm_up;
                listener.at(lane, *origin).search(&destinations);
            }
            Event::Access(access) => {
                listener.at(lane, *origin).access(access);
                return Ok(true);
            }
            Event::SearchEnd => listener.at(lane, *origin).search_end(),
        }
    }
    Ok(false)
}
