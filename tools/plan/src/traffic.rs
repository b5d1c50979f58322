//! What a recipe costs where memory is what is scarce: bytes fetched for its searches, by those of a few numbers of photons and
//! neighbours.

use crate::recipe::Recipe;

/// Why bytes could not be measured.
pub type Trouble = Box<dyn std::error::Error + Send + Sync>;

/// Bytes that a search for so many of so many photons fetches, in a picture's order with the store that there is.
pub type SearchBytes<'a> = dyn Fn(u32, u64) -> Result<f64, Trouble> + 'a;

/// Bytes fetched for each search, measured for each of [`PHOTONS`] and [`NEIGHBOURS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Traffic([[f64; NEIGHBOURS.len()]; PHOTONS.len()]);

/// Photons of maps that are measured. Whether a map fits on the chip is decided between the first and the last.
const PHOTONS: [u64; 4] = [5_000, 20_000, 80_000, 320_000];
/// Neighbours that are searched for.
const NEIGHBOURS: [u32; 2] = [10, 40];

impl Traffic {
    pub(crate) fn measure(of: &SearchBytes<'_>) -> Result<Self, Trouble> {
        let mut found = [[0.0; NEIGHBOURS.len()]; PHOTONS.len()];
        for (row, &photons) in found.iter_mut().zip(&PHOTONS) {
            for (bytes, &k) in row.iter_mut().zip(&NEIGHBOURS) {
                *bytes = of(k, photons)?;
            }
        }
        Ok(Self(found))
    }

    /// Bytes that a recipe fetches for so many pixels: linear in the neighbours and in the logarithm of the photons, between what
    /// was measured and beyond.
    #[must_use]
    pub fn of(&self, recipe: &Recipe, pixels: f64) -> f64 {
        let log = |n: u64| libm::log(n as f64);
        let above = PHOTONS.iter().position(|&n| n >= recipe.photons).unwrap_or(PHOTONS.len() - 1).max(1);
        let between = |at: f64, [from, to]: [f64; 2], [a, b]: [f64; 2]| a + (b - a) * (at - from) / (to - from);
        let logs = [log(PHOTONS[above - 1]), log(PHOTONS[above])];
        let by_k = |k: usize| between(log(recipe.photons), logs, [self.0[above - 1][k], self.0[above][k]]);
        let ks = NEIGHBOURS.map(f64::from);
        let search = between(f64::from(recipe.k), ks, [by_k(0), by_k(1)]).max(0.0);
        pixels * f64::from(recipe.samples) * f64::from(recipe.gathers) * search
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECIPE: Recipe = Recipe { samples: 9, gathers: 4, light_samples: 1, photons: 40_000, k: 20, caustics: 0 };

    #[test]
    fn bytes_are_those_of_all_searches() {
        // 3 bytes a neighbour, and 7 for each time that there are e times as many photons.
        let law = |k: u32, n: u64| 3.0 * f64::from(k) + 7.0 * libm::log(n as f64);
        let traffic = Traffic::measure(&|k, n| Ok(law(k, n))).unwrap();
        for recipe in
            [RECIPE, Recipe { photons: 2_000_000, k: 80, ..RECIPE }, Recipe { photons: 5_000, k: 10, ..RECIPE }]
        {
            let expected = 100.0 * 36.0 * law(recipe.k, recipe.photons);
            assert!((traffic.of(&recipe, 100.0) / expected - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_map_that_fits_costs_nothing() {
        let traffic = Traffic::measure(&|_, n| Ok(if n > 20_000 { 500.0 } else { 0.0 })).unwrap();
        assert_eq!(traffic.of(&Recipe { photons: 20_000, ..RECIPE }, 100.0), 0.0);
        assert!(traffic.of(&RECIPE, 100.0) > 0.0);
    }
}
