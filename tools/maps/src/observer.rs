//! Eyes in the one search: which records are read.

/// Is told of every record a search reads, as it is reached and before its children are.
pub trait AccessObserver {
    /// Record number `record` of region number `region` is read as a whole.
    fn read(&mut self, region: u16, record: u32);

    /// A record read before is looked at again, after all that lies below it.
    #[inline(always)]
    fn reread(&mut self, region: u16, record: u32) {
        let _ = (region, record);
    }

    /// The distances of this many photons are computed.
    #[inline(always)]
    fn examined(&mut self, photons: usize) {
        let _ = photons;
    }
}

/// Sees nothing and costs nothing.
pub struct Blind;

impl AccessObserver for Blind {
    #[inline(always)]
    fn read(&mut self, _: u16, _: u32) {}
}

/// Remembers the reads of one search.
#[derive(Default)]
pub struct Visits {
    /// Do second touches count as reads?
    log_rereads: bool,
    rereads: u64,
    examined: u64,
    records: Vec<u32>,
    /// Region and end (in `records`) of each run of reads of one region.
    runs: Vec<(u16, usize)>,
}

impl Visits {
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

impl AccessObserver for Visits {
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
}

/// Counts reads.
impl AccessObserver for u64 {
    #[inline]
    fn read(&mut self, _: u16, _: u32) {
        *self += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_cut_where_the_region_changes() {
        let mut visits = Visits::default();
        for (region, record) in [(0, 5), (0, 6), (1, 5), (0, 7)] {
            visits.read(region, record);
        }
        let runs: Vec<_> = visits.runs().map(|(region, records)| (region, records.to_vec())).collect();
        assert_eq!(runs, [(0, vec![5, 6]), (1, vec![5]), (0, vec![7])]);
        visits.clear();
        assert!(visits.is_empty() && visits.runs().next().is_none());
    }
}
