//! Eyes in the one search: which records are read.

use super::{AnyMap, Nearest};
use pm_formats::trace::Waits;

/// Is told of every record a search reads, as it is reached and before its children are.
pub trait AccessObserver {
    /// Record number `record` of region number `region` is read as a whole.
    fn read(&mut self, region: u16, record: u32);

    /// The same, of a map that [tells what its reads wait for](crate::PhotonMap::tells_waits).
    #[inline(always)]
    fn read_after(&mut self, region: u16, record: u32, waits: Waits) {
        let _ = waits;
        self.read(region, record);
    }

    /// The same if `is_read`.
    #[inline(always)]
    fn read_after_if(&mut self, is_read: bool, region: u16, record: u32, waits: Waits) {
        if is_read {
            self.read_after(region, record, waits);
        }
    }

    /// The search begins anew, since it did not find enough.
    #[inline(always)]
    fn again(&mut self) {}

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

    /// Watches a search in a map whose type is not known.
    fn look_into(&mut self, map: &(dyn AnyMap + '_), point: [f32; 3], found: &mut Nearest)
    where
        Self: Sized,
    {
        map.nearest_seen(point, found, self);
    }
}

/// An observer whose type is not known.
impl AccessObserver for &mut (dyn AccessObserver + '_) {
    fn read(&mut self, region: u16, record: u32) {
        (**self).read(region, record);
    }

    fn read_after(&mut self, region: u16, record: u32, waits: Waits) {
        (**self).read_after(region, record, waits);
    }

    fn again(&mut self) {
        (**self).again();
    }

    fn reread(&mut self, region: u16, record: u32) {
        (**self).reread(region, record);
    }

    fn examined(&mut self, photons: usize) {
        (**self).examined(photons);
    }
}

/// Sees nothing and costs nothing.
pub struct Blind;

impl AccessObserver for Blind {
    #[inline(always)]
    fn read(&mut self, _: u16, _: u32) {}

    #[inline]
    fn look_into(&mut self, map: &(dyn AnyMap + '_), point: [f32; 3], found: &mut Nearest) {
        map.nearest_blind(point, found);
    }
}

/// Counts reads.
impl AccessObserver for u64 {
    #[inline]
    fn read(&mut self, _: u16, _: u32) {
        *self += 1;
    }
}
