//! Photons traced once, of which the first n of whole paths are a map of their own.

use pm_formats::Photon;
use pm_light::transport::PhotonPaths;

/// Photons of the paths of one seed, as many as were asked for so far.
pub(crate) struct Traced<'a> {
    paths: PhotonPaths<'a>,
    photons: Vec<Photon>,
    /// After how many photons each path ends.
    ends: Vec<usize>,
}

/// The photons of a map, and the number of paths that were emitted for them.
#[derive(Clone, Copy)]
pub(crate) struct Photons<'a> {
    pub(crate) photons: &'a [Photon],
    pub(crate) emitted: u64,
}

/// Paths that store nothing, one after the other, before a scene is thought to be dark.
const PATIENCE: usize = 1 << 20;

impl<'a> Traced<'a> {
    /// None yet.
    pub(crate) const fn new(paths: PhotonPaths<'a>) -> Self {
        Self { paths, photons: vec![], ends: vec![] }
    }

    /// The photons of the first paths that store at least `n`, as `pm-photons -n` has them; `None` if too few paths store any,
    /// or a power is beyond what a photon can hold.
    pub(crate) fn first(&mut self, n: u64) -> Option<Photons<'_>> {
        let wanted = usize::try_from(n).ok()?;
        let mut fruitless = 0;
        while self.photons.len() < wanted {
            let before = self.photons.len();
            let mut found = vec![];
            self.paths.trace(self.ends.len() as u64, |photon| found.push(photon));
            for photon in &found {
                self.photons.push(self.paths.pack(self.photons.len() as u64, photon)?);
            }
            fruitless = if self.photons.len() == before { fruitless + 1 } else { 0 };
            if fruitless > PATIENCE {
                return None;
            }
            self.ends.push(self.photons.len());
        }
        self.known(n)
    }

    /// The same of photons that have been traced already.
    pub(crate) fn known(&self, n: u64) -> Option<Photons<'_>> {
        let wanted = usize::try_from(n).ok()?;
        let last = self.ends.partition_point(|&end| end < wanted);
        let end = self.ends.get(last).copied()?;
        Some(Photons { photons: &self.photons[..end], emitted: last as u64 + 1 })
    }

    /// The photons traced so far dealt out to `lots` maps that have nothing in common: each has as many whole paths, those that
    /// follow one another.
    pub(crate) fn lots(&self, lots: usize) -> Vec<Photons<'_>> {
        let paths = self.ends.len() / lots.max(1);
        let end_of = |path: usize| if path == 0 { 0 } else { self.ends[path - 1] };
        let lot = |at: usize| {
            let photons = &self.photons[end_of(at * paths)..end_of((at + 1) * paths)];
            Photons { photons, emitted: paths as u64 }
        };
        (0..lots).map(lot).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_light::scene::Scene;

    #[test]
    fn the_first_of_many_are_what_a_smaller_trace_gives() {
        let scene = Scene::embedded();
        let mut many = Traced::new(PhotonPaths::new(&scene, 5));
        let all = many.first(3000).map(|found| (found.photons.len(), found.emitted)).unwrap();
        let few = many.first(500).map(|found| (found.photons.to_vec(), found.emitted)).unwrap();
        let mut afresh = Traced::new(PhotonPaths::new(&scene, 5));
        let same = afresh.first(500).unwrap();
        assert!(few.0 == same.photons && few.1 == same.emitted);
        assert!(all.0 >= 3000 && all.1 > few.1 && few.0.len() >= 500);
        // Flux counts by path: as much for few as for many, give or take chance.
        assert!((all.0 as f64 / all.1 as f64 / (few.0.len() as f64 / few.1 as f64) - 1.0).abs() < 0.2);
        // Lots share nothing and leave out less than a lot.
        let lots = many.lots(7);
        let dealt: Vec<Photon> = lots.iter().flat_map(|lot| lot.photons.to_vec()).collect();
        assert!(dealt == many.photons[..dealt.len()] && lots.iter().all(|lot| lot.emitted == lots[0].emitted));
        assert!(many.photons.len() - dealt.len() < 7 * 100 && lots[0].emitted == all.1 / 7);
    }
}
