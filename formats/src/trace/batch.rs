//! Accesses on their way to whoever listens, many at a time.

use super::Waits;
use super::access::{Access, TraceSink};

/// A sink, and accesses of the search in hand that it has not yet heard of: a call for each would cost more than it takes to
/// read one.
pub(super) struct Batch<'a> {
    sink: &'a mut dyn TraceSink,
    waiting: Box<[Access; ROOM]>,
    len: usize,
}

const ROOM: usize = 128;

impl<'a> Batch<'a> {
    pub(super) fn new(sink: &'a mut dyn TraceSink) -> Self {
        Self { sink, waiting: Box::new([Access::read(0, 0, 0); ROOM]), len: 0 }
    }

    /// See [`TraceSink::search`].
    pub(super) fn search(&mut self, destinations: &[u32]) {
        self.sink.search(destinations);
    }

    /// See [`TraceSink::waits`].
    pub(super) fn waits(&mut self, waits: Waits) {
        self.tell();
        self.sink.waits(waits);
    }

    /// See [`TraceSink::access`].
    #[inline]
    pub(super) fn access(&mut self, access: Access) {
        self.waiting[self.len % ROOM] = access;
        self.len += 1;
        if self.len == ROOM {
            self.tell();
        }
    }

    /// See [`TraceSink::records`].
    pub(super) fn records(&mut self, region: u16, size: u32, records: &[u32]) {
        self.tell();
        self.sink.records(region, size, records);
    }

    /// See [`TraceSink::search_end`].
    pub(super) fn search_end(&mut self) {
        self.tell();
        self.sink.search_end();
    }

    fn tell(&mut self) {
        if self.len > 0 {
            self.sink.accesses(&self.waiting[..self.len]);
            self.len = 0;
        }
    }
}
