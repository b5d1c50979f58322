//! Any photon map behind one face, for those who choose one when the program runs.

use super::{AccessObserver, Ball, Nearest, PhotonMap, SearchReads, Vicinity};
use pm_formats::Number;
use pm_formats::trace::Region;
use std::sync::Arc;

/// A [`PhotonMap`] as an object: every map has this face, and behind it is a [`PhotonMap`] again. Its methods are those of
/// the map; the search has a method for each observer that matters for speed, so that a call costs once a search and not
/// once a record.
pub trait AnyMap: Send + Sync {
    /// See [`PhotonMap::regions`].
    fn regions(&self, reread: bool) -> Vec<Region>;
    /// See [`PhotonMap::len`].
    fn len(&self) -> usize;
    /// See [`PhotonMap::is_empty`].
    fn is_empty(&self) -> bool;
    /// See [`PhotonMap::padding`].
    fn padding(&self) -> Option<u32>;
    /// See [`PhotonMap::is_exact`].
    fn is_exact(&self) -> bool;
    /// See [`PhotonMap::order`].
    fn order(&self) -> Option<&Arc<[u32]>>;
    /// See [`PhotonMap::narrows`].
    fn narrows(&self) -> bool;
    /// See [`PhotonMap::tells_waits`].
    fn tells_waits(&self) -> bool;
    /// See [`PhotonMap::measures`].
    fn measures(&self) -> Vec<(&'static str, Number)>;
    /// See [`PhotonMap::blocks`].
    fn blocks(&self) -> Option<(u16, Vec<u32>)>;
    /// See [`PhotonMap::batch`].
    fn batch(&self) -> Option<usize>;
    /// [`PhotonMap::nearest_of_all`] with its reads remembered.
    fn nearest_of_all_read(&self, points: &[[f32; 3]], found: &mut [&mut Nearest], reads: &mut SearchReads);
    /// See [`PhotonMap::group`].
    fn group(&self) -> usize;
    /// [`PhotonMap::surround`] seen by nobody.
    fn surround_blind(&self, ball: &Ball, into: &mut Vicinity, room: &mut Nearest) -> bool;
    /// [`PhotonMap::surround`] with its reads remembered.
    fn surround_read(&self, ball: &Ball, into: &mut Vicinity, room: &mut Nearest, reads: &mut SearchReads) -> bool;
    /// See [`PhotonMap::nearest_of_surrounding`].
    fn nearest_of_surrounding(&self, vicinity: &Vicinity, point: [f32; 3], max_dist: f32, found: &mut Nearest);
    /// [`PhotonMap::nearest`] seen by nobody.
    fn nearest_blind(&self, point: [f32; 3], found: &mut Nearest);
    /// [`PhotonMap::nearest`] with its reads remembered.
    fn nearest_read(&self, point: [f32; 3], found: &mut Nearest, reads: &mut SearchReads);
    /// [`PhotonMap::nearest`] with any observer, which is called for each read.
    fn nearest_seen(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut dyn AccessObserver);
}

impl<M: PhotonMap> AnyMap for M {
    fn regions(&self, reread: bool) -> Vec<Region> {
        PhotonMap::regions(self, reread)
    }

    fn len(&self) -> usize {
        PhotonMap::len(self)
    }

    fn is_empty(&self) -> bool {
        PhotonMap::is_empty(self)
    }

    fn padding(&self) -> Option<u32> {
        PhotonMap::padding(self)
    }

    fn is_exact(&self) -> bool {
        PhotonMap::is_exact(self)
    }

    fn order(&self) -> Option<&Arc<[u32]>> {
        PhotonMap::order(self)
    }

    fn narrows(&self) -> bool {
        PhotonMap::narrows(self)
    }

    fn tells_waits(&self) -> bool {
        PhotonMap::tells_waits(self)
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        PhotonMap::measures(self)
    }

    fn blocks(&self) -> Option<(u16, Vec<u32>)> {
        PhotonMap::blocks(self)
    }

    fn batch(&self) -> Option<usize> {
        PhotonMap::batch(self)
    }

    fn nearest_of_all_read(&self, points: &[[f32; 3]], found: &mut [&mut Nearest], reads: &mut SearchReads) {
        self.nearest_of_all(points, found, reads);
    }

    fn group(&self) -> usize {
        PhotonMap::group(self)
    }

    fn surround_blind(&self, ball: &Ball, into: &mut Vicinity, room: &mut Nearest) -> bool {
        self.surround(ball, into, room, &mut super::Blind)
    }

    fn surround_read(&self, ball: &Ball, into: &mut Vicinity, room: &mut Nearest, reads: &mut SearchReads) -> bool {
        self.surround(ball, into, room, reads)
    }

    fn nearest_of_surrounding(&self, vicinity: &Vicinity, point: [f32; 3], max_dist: f32, found: &mut Nearest) {
        PhotonMap::nearest_of_surrounding(self, vicinity, point, max_dist, found);
    }

    fn nearest_blind(&self, point: [f32; 3], found: &mut Nearest) {
        self.nearest(point, found, &mut super::Blind);
    }

    fn nearest_read(&self, point: [f32; 3], found: &mut Nearest, reads: &mut SearchReads) {
        self.nearest(point, found, reads);
    }

    fn nearest_seen(&self, point: [f32; 3], found: &mut Nearest, mut eyes: &mut dyn AccessObserver) {
        self.nearest(point, found, &mut eyes);
    }
}

/// What a search is written for serves both: a map whose type is known, and one behind its face.
impl PhotonMap for dyn AnyMap + '_ {
    fn regions(&self, reread: bool) -> Vec<Region> {
        AnyMap::regions(self, reread)
    }

    fn len(&self) -> usize {
        AnyMap::len(self)
    }

    fn padding(&self) -> Option<u32> {
        AnyMap::padding(self)
    }

    fn is_exact(&self) -> bool {
        AnyMap::is_exact(self)
    }

    fn order(&self) -> Option<&Arc<[u32]>> {
        AnyMap::order(self)
    }

    fn narrows(&self) -> bool {
        AnyMap::narrows(self)
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        AnyMap::measures(self)
    }

    fn blocks(&self) -> Option<(u16, Vec<u32>)> {
        AnyMap::blocks(self)
    }

    fn batch(&self) -> Option<usize> {
        AnyMap::batch(self)
    }

    #[inline]
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        eyes.look_into(self, point, found);
    }
}
