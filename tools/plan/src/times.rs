//! What a recipe costs: processor time, by what its parts took in the pilots.

use crate::recipe::{CAUSTICS_K, DESIGNS, MOST_SEEN, Recipe, nth_design};

/// Seconds of processor time that parts of the work took here, a while ago.
#[derive(Clone, Debug, Default)]
pub struct Times {
    /// A photon traced and put into a map.
    pub photon: f64,
    /// An eye ray with its gather and shadow rays, without searches, for each of [`DESIGNS`].
    pub rays: [f64; DESIGNS.len()],
    /// A search for so many photons, in a map of [`of`](Self::of).
    pub searches: Vec<(u32, f64)>,
    /// Photons of the map in which searches were measured.
    pub of: u64,
    /// By how much a search takes longer in a map of e times as many photons, as a share.
    pub growth: f64,
    /// A photon of caustics traced and put into a map.
    pub caustic: f64,
    /// What is to be done before the first of them.
    pub aiming: f64,
    /// A point seen that asks for caustics.
    pub seen: f64,
}

impl Times {
    /// Seconds of processor time that a recipe takes for so many pixels.
    #[must_use]
    pub fn of(&self, recipe: &Recipe, pixels: f64) -> f64 {
        let samples = f64::from(recipe.samples);
        let seen = f64::from(recipe.samples.min(MOST_SEEN));
        let rays = self.rays[nth_design(recipe.gathers, recipe.light_samples)];
        let sample = rays + f64::from(recipe.gathers) * self.search(recipe.k, recipe.photons);
        let caustics = if recipe.caustics == 0 {
            0.0
        } else {
            self.aiming + recipe.caustics as f64 * self.caustic + pixels * seen * self.seen
        };
        recipe.photons as f64 * self.photon + pixels * samples * sample + caustics
    }

    /// A search for k of n photons.
    fn search(&self, k: u32, n: u64) -> f64 {
        let known = self.searches.iter().min_by_key(|(other, _)| other.abs_diff(k));
        let growth = 1.0 + self.growth * libm::log(n as f64 / self.of.max(1) as f64);
        known.map_or(0.0, |(_, seconds)| seconds * growth.max(0.2))
    }

    /// Photons of caustics that are asked for at each point.
    pub(crate) const CAUSTICS_K: u32 = CAUSTICS_K;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recipe_costs_the_sum_of_its_parts() {
        let times = Times {
            photon: 1e-6,
            rays: DESIGNS.map(|[gathers, _]| 1e-5 + 2e-6 * f64::from(gathers)),
            searches: vec![(10, 3e-6), (40, 8e-6)],
            of: 1000,
            growth: 0.1,
            caustic: 1e-5,
            aiming: 0.5,
            seen: 4e-6,
        };
        let recipe = Recipe { samples: 25, gathers: 4, light_samples: 1, photons: 1000, k: 12, caustics: 0 };
        let sample = 1e-5 + 4.0 * 5e-6;
        assert!((times.of(&recipe, 100.0) - (1e-3 + 2500.0 * sample)).abs() < 1e-12);
        let caustics = Recipe { caustics: 2000, ..recipe };
        let more = times.of(&caustics, 100.0) - times.of(&recipe, 100.0);
        assert!((more - (0.5 + 0.02 + 1600.0 * 4e-6)).abs() < 1e-12);
        assert!(
            times.of(&Recipe { photons: 2718, ..recipe }, 100.0) > times.of(&recipe, 100.0) + 2500.0 * 4.0 * 2.9e-7
        );
    }
}
