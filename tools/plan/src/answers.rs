//! Radiance of pixels by a photon map, for several numbers of neighbours at once.

use crate::rays::RaySet;
use crate::replicates::Values;
use crate::traced::Photons;
use pm_formats::Material;
use pm_gathering::{Edges, EstimateOptions, Estimator, Kernel, Outcome, RadianceEstimate, Scratch};
use pm_maps::{AnyMap, Blind, BuildError, Nearest, Search, Setting, fastest, structures};

/// A map built of photons, as `pm-gather` builds it where nobody asks what it reads.
pub(crate) struct Map<'a> {
    built: Box<dyn AnyMap>,
    photons: Photons<'a>,
}

/// How a map is asked.
#[derive(Clone, Copy)]
pub(crate) struct Asking<'a> {
    pub(crate) materials: &'a [Material],
    pub(crate) kernel: Kernel,
}

impl<'a> Map<'a> {
    /// Builds it, to be asked for at most `k` neighbours.
    pub(crate) fn build(photons: Photons<'a>, k: u32) -> Result<Self, BuildError> {
        let structure = fastest();
        let values = structures().choose(structure.word()).expect("the fastest is one of them").values;
        let built = structure.build(Setting { values: &values, photons: photons.photons, k: k as usize })?;
        Ok(Self { built, photons })
    }

    /// What the queries add to their pixels, for each of `ks`, which ascend.
    pub(crate) fn values(&self, asking: Asking<'_>, set: &RaySet, ks: &[u32]) -> Vec<Values> {
        let most = ks.last().copied().unwrap_or(1) as usize;
        let search = Search::new(most, f32::INFINITY).fit_start(&*self.built, self.photons.photons);
        let estimate = |&k: &u32| asking.estimate(self.photons, k);
        let estimates: Vec<RadianceEstimate<'_>> = ks.iter().map(estimate).collect();
        let mut values = vec![vec![[0.0; 3]; set.ends.len()]; ks.len()];
        let mut found = Nearest::new(most, f32::INFINITY);
        let mut fewer: Vec<Nearest> = ks.iter().map(|&k| Nearest::new(k as usize, f32::INFINITY)).collect();
        let mut scratch = Scratch::default();
        let mut pixel = 0;
        for (at, query) in set.queries.iter().enumerate() {
            while set.ends[pixel] <= at {
                pixel += 1;
            }
            search.run(&*self.built, query.position, &mut found, &mut Blind);
            let sorted = if ks.len() > 1 { found.sorted() } else { vec![] };
            for (i, estimate) in estimates.iter().enumerate() {
                let nearest = if ks.len() > 1 {
                    fewer[i].restart(f32::INFINITY);
                    sorted.iter().take(ks[i] as usize).for_each(|&(distance, id)| fewer[i].show(distance, id));
                    &fewer[i]
                } else {
                    &found
                };
                if let Outcome::Radiance(radiance) = estimate.contribution(query, nearest, &mut scratch) {
                    (0..3).for_each(|c| values[i][pixel][c] += radiance[c]);
                }
            }
        }
        values
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
