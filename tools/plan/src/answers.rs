//! Radiance of pixels by a photon map, for several numbers of neighbours at once.

use crate::rays::RaySet;
use crate::replicates::Values;
use crate::traced::Photons;
use pm_formats::{Material, Query};
use pm_gathering::{Edges, EstimateOptions, Estimator, Kernel, Outcome, RadianceEstimate, Scratch};
use pm_maps::{AnyMap, Blind, BuildError, Nearest, Search, Setting, fastest, structures};
use std::rc::Rc;

/// A map built of photons, as `pm-gather` builds it where nobody asks what it reads, and what it takes to ask it for some numbers
/// of neighbours.
pub(crate) struct Map<'a> {
    built: Rc<dyn AnyMap>,
    photons: Photons<'a>,
    asking: Asking<'a>,
    /// Ascending in neighbours.
    estimates: Vec<(u32, RadianceEstimate<'a>)>,
    search: Search,
}

/// How a map is asked.
#[derive(Clone, Copy)]
pub(crate) struct Asking<'a> {
    pub(crate) materials: &'a [Material],
    pub(crate) kernel: Kernel,
}

impl<'a> Map<'a> {
    /// Builds it, to be asked for each of `ks` neighbours, which ascend.
    pub(crate) fn build(photons: Photons<'a>, asking: Asking<'a>, ks: &[u32]) -> Result<Self, BuildError> {
        let k = ks.last().copied().unwrap_or(1) as usize;
        let structure = fastest();
        let values = structures().choose(structure.word()).expect("the fastest is one of them").values;
        let built = structure.build(Setting { values: &values, photons: photons.photons, k })?;
        Ok(Self::asked(built.into(), photons, asking, ks))
    }

    /// The same map, to be asked for other numbers of neighbours, which ascend, and are no more.
    pub(crate) fn for_others(&self, ks: &[u32]) -> Self {
        Self::asked(Rc::clone(&self.built), self.photons, self.asking, ks)
    }

    fn asked(built: Rc<dyn AnyMap>, photons: Photons<'a>, asking: Asking<'a>, ks: &[u32]) -> Self {
        let most = ks.last().copied().unwrap_or(1);
        let estimate = |&k: &u32| {
            let plain = asking.estimate(photons, k);
            // All that were found are known by their places in the map, the nearest of them by their ids.
            (k, if k == most { plain.in_order(built.order()) } else { plain })
        };
        let estimates = ks.iter().map(estimate).collect();
        let search = Search::new(most as usize, f32::INFINITY).fit_start(&*built, photons.photons);
        Self { built, photons, asking, estimates, search }
    }

    /// What the queries add to their pixels, for each of the numbers of neighbours.
    pub(crate) fn values(&self, set: &RaySet) -> Vec<Values> {
        let mut values = vec![vec![[0.0; 3]; set.ends.len()]; self.estimates.len()];
        let mut found = Nearest::new(self.search.k, f32::INFINITY);
        let few = self.estimates.len().saturating_sub(1);
        let room = |&(k, _): &(u32, RadianceEstimate<'_>)| Nearest::new(k as usize, f32::INFINITY);
        let mut fewer: Vec<Nearest> = self.estimates[..few].iter().map(room).collect();
        let mut scratch = Scratch::default();
        let mut near = vec![];
        let mut pixel = 0;
        for (at, query) in set.queries.iter().enumerate() {
            while set.ends[pixel] <= at {
                pixel += 1;
            }
            self.search.run(&*self.built, query.position, &mut found, &mut Blind);
            let mut add = |nth: usize, query: &Query, nearest: &Nearest| {
                if let Outcome::Radiance(radiance) = self.estimates[nth].1.contribution(query, nearest, &mut scratch) {
                    (0..3).for_each(|c| values[nth][pixel][c] += radiance[c]);
                }
            };
            add(few, query, &found);
            near.clear();
            if few > 0 {
                near.extend(found.iter());
            }
            for (nth, nearest) in fewer.iter_mut().enumerate().rev() {
                keep_nearest(&mut near, nearest.k());
                nearest.restart(f32::INFINITY);
                near.iter().for_each(|&(distance, id)| nearest.show(distance, id));
                add(nth, query, nearest);
            }
        }
        values
    }
}

/// Of photons, squared distances with ids, keeps the k nearest; of those that are as far, the first by id.
fn keep_nearest(photons: &mut Vec<(f32, u32)>, k: usize) {
    if photons.len() > k {
        photons.select_nth_unstable_by(k, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        photons.truncate(k);
    }
}

impl<'a> Asking<'a> {
    /// As `pm-gather` estimates radiance unless it is told otherwise.
    fn estimate(&self, map: Photons<'a>, k: u32) -> RadianceEstimate<'a> {
        let options = EstimateOptions {
            k: k as usize,
            max_dist: f32::INFINITY,
            estimator: Estimator::Unbiased,
            kernel: self.kernel,
            edges: Edges::Cut,
        };
        RadianceEstimate::new(map.photons, self.materials, map.emitted, options)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rays::{Design, cast};
    use crate::traced::Traced;
    use pm_light::scene::{Camera, CameraOverrides, Scene};
    use pm_light::transport::{PhotonPaths, Surfaces};

    #[test]
    fn many_numbers_of_neighbours_at_once_say_what_each_says_alone() {
        let scene = Scene::embedded();
        let camera = Camera::embedded(&CameraOverrides::default()).expect("a camera").camera;
        let plain = |of: &pm_light::scene::Material| Material {
            name: of.name.clone(),
            diffuse: of.diffuse,
            specular: [0.0; 3],
            exponent: 0.0,
        };
        let materials: Vec<Material> = scene.materials.iter().map(plain).collect();
        let mut traced = Traced::new(PhotonPaths::new(&scene, 3));
        let photons = traced.first(4000).expect("photons");
        let pixels: Vec<[u32; 2]> = (0..64).map(|at| [at * 8, 500 - at * 7]).collect();
        let design = Design { samples: 4, gathers: 2, light_samples: 1 };
        let set = cast(&Surfaces::new(&scene), camera, &pixels, design.soft(5, false));
        let asking = Asking { materials: &materials, kernel: Kernel::Constant };
        let map = Map::build(photons, asking, &[5, 20, 80]).expect("a map");
        for (k, together) in [5, 20, 80].into_iter().zip(map.values(&set)) {
            let alone = Map::build(photons, asking, &[k]).expect("a map").values(&set);
            assert_eq!(alone, map.for_others(&[k]).values(&set));
            assert_eq!(alone, [together]);
        }
    }

    #[test]
    fn of_photons_as_far_the_first_are_kept() {
        let mut photons = vec![(2.0, 7), (1.0, 9), (2.0, 3), (2.0, 5), (0.0, 8)];
        keep_nearest(&mut photons, 3);
        photons.sort_by_key(|photon| photon.1);
        assert_eq!(photons, [(2.0, 3), (0.0, 8), (1.0, 9)]);
    }
}
