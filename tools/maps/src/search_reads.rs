//! What a search read.

use super::{AccessObserver, AnyMap, Nearest};
use pm_formats::trace::Waits;

/// Remembers the reads of one search.
#[derive(Default)]
pub struct SearchReads {
    /// Do second touches count as reads?
    log_rereads: bool,
    rereads: u64,
    examined: u64,
    records: Vec<u32>,
    /// Region and end (in `records`) of each run of reads of one region.
    runs: Vec<(u16, usize)>,
}

impl SearchReads {
    /// An observer that also remembers second touches, each as a read of its own.
    #[must_use]
    pub fn with_rereads(log_rereads: bool) -> Self {
        Self { log_rereads, ..Self::default() }
    }

    /// Number of second touches, remembered or not.
    #[must_use]
    pub const fn rereads(&self) -> u64 {
        self.rereads
    }

    /// Number of photons whose distance was computed.
    #[must_use]
    pub const fn photons_examined(&self) -> u64 {
        self.examined
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.rereads = 0;
        self.examined = 0;
        self.records.clear();
        self.runs.clear();
    }

    /// Number of reads.
    #[must_use]
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// True if nothing was read.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// The reads in order, cut where the region changes.
    pub fn runs(&self) -> impl Iterator<Item = (u16, &[u32])> {
        self.runs.iter().scan(0, |from, &(region, end)| {
            let run = &self.records[*from..end];
            *from = end;
            Some((region, run))
        })
    }
}

impl AccessObserver for SearchReads {
    #[inline]
    fn read(&mut self, region: u16, record: u32) {
        self.records.push(record);
        let end = self.records.len();
        match self.runs.last_mut() {
            Some(run) if run.0 == region => run.1 = end,
            _ => self.runs.push((region, end)),
        }
    }

    #[inline]
    fn read_after_if(&mut self, is_read: bool, region: u16, record: u32, _: Waits) {
        match self.runs.last_mut() {
            // No branch to be guessed.
            Some(run) if run.0 == region => {
                let end = self.records.len() + usize::from(is_read);
                self.records.push(record);
                self.records.truncate(end);
                run.1 = end;
            }
            _ if is_read => self.read(region, record),
            _ => {}
        }
    }

    #[inline]
    fn reread(&mut self, region: u16, record: u32) {
        self.rereads += 1;
        if self.log_rereads {
            self.read(region, record);
        }
    }

    #[inline]
    fn examined(&mut self, photons: usize) {
        self.examined += photons as u64;
    }

    #[inline]
    fn look_into(&mut self, map: &(dyn AnyMap + '_), point: [f32; 3], found: &mut Nearest) {
        map.nearest_read(point, found, self);
    }
}

#[cfg(test)]
mod tests;
