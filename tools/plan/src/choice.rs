//! The cheapest recipe that will do, and those that it beats.

use crate::Recipe;
use crate::model::{Model, Parts};
use crate::recipe::DESIGNS;
use crate::survey::KS;
use crate::task::is_large;
use std::sync::LazyLock;

/// A recipe with what it gives and takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The recipe.
    pub recipe: Recipe,
    /// The square of its error.
    pub parts: Parts,
    /// What it costs, as [`Model::cost`] has it.
    pub cost: f64,
}

/// A recipe that lost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rival {
    /// It would do, but costs more.
    Dearer(Choice),
    /// It costs less, but would not do.
    TooCoarse(Choice),
}

/// Neighbours that are planned with. An estimate by fewer has rare and large errors, which few pixels do not show.
const PLANNED: std::ops::Range<usize> = 1..KS.len();
/// Fewest and most photons that are planned with.
const PHOTONS: [u64; 2] = [5_000, 20_000_000];
/// Fewest photons of caustics that are planned with.
const CAUSTICS: u64 = 6_250;

/// How often planning traces the photons of what is chosen: for two maps of a trial and two that are sharper, and for small pictures
/// by which time is measured.
const TRACED: f64 = 10.0;

/// Seconds that differ by less are alike: they were measured on a few pixels, beside other work. Of such recipes the one with the fewest
/// photons is taken, which needs the least memory and fetches the least of it.
const ALIKE: f64 = 1.1;

/// The cheapest recipe whose error is at most `error` even at the upper bound of its interval, `errors` standard errors off; all
/// that were looked at, one for each combination of all but the eye rays: first those that cost about as much as the cheapest, by
/// their photons, then the others, by their cost. `caustics` is the most photons of caustics there may be. Of a large picture, what
/// counts is what it costs until it is there: photons are traced by planning too, however few pixels that makes.
#[must_use]
pub fn choose(model: &Model, pixels: f64, error: f64, errors: f64, caustics: u64) -> Vec<Choice> {
    let mut found: Vec<Choice> =
        skeletons(caustics).filter_map(|recipe| least_samples(model, recipe, pixels, error, errors)).collect();
    let traced = if is_large(pixels) { TRACED } else { 0.0 };
    let with_planning = |choice: &Choice| choice.cost + traced * model.cost(&choice.recipe, 0.0);
    found.sort_by(|a, b| with_planning(a).total_cmp(&with_planning(b)));
    // Bytes are what they are.
    let by_time = model.fetched(&Recipe::default(), pixels).is_none();
    let least = found.first().map_or(0.0, with_planning);
    let alike = found.partition_point(|choice| by_time && with_planning(choice) <= ALIKE * least);
    found[..alike].sort_by_key(|choice| choice.recipe.photons);
    found
}

/// For each error, the cheapest recipe that is predicted to have no more; none where nothing does.
#[must_use]
pub fn frontier(model: &Model, pixels: f64, errors: &[f64], caustics: u64) -> Vec<Choice> {
    frontier_among(&skeletons(caustics).collect::<Vec<_>>(), model, pixels, errors)
}

/// The same where maps are to have so many photons, and to be asked for so many neighbours.
#[must_use]
pub fn frontier_of_map(
    model: &Model,
    pixels: f64,
    errors: &[f64],
    caustics: u64,
    (photons, k): (u64, u32),
) -> Vec<Choice> {
    let of_one_map = |recipe: &Recipe| (recipe.photons, recipe.k) == (PHOTONS[0], KS[PLANNED.start]);
    let with_map = |recipe| Recipe { photons, k, ..recipe };
    frontier_among(&skeletons(caustics).filter(of_one_map).map(with_map).collect::<Vec<_>>(), model, pixels, errors)
}

fn frontier_among(recipes: &[Recipe], model: &Model, pixels: f64, errors: &[f64]) -> Vec<Choice> {
    let cheapest = |&error: &f64| {
        let found = recipes.iter().filter_map(|&recipe| least_samples(model, recipe, pixels, error, 0.0));
        found.min_by(|a, b| a.cost.total_cmp(&b.cost))
    };
    errors.iter().filter_map(cheapest).collect()
}

/// The recipe of least error that costs at most so much, by its estimate without its interval.
#[must_use]
pub fn nearest_in(model: &Model, pixels: f64, cost: f64, caustics: u64) -> Option<Choice> {
    let with_most_samples = |recipe: Recipe| {
        let affordable = |samples: &u32| model.cost(&Recipe { samples: *samples, ..recipe }, pixels) <= cost;
        let samples = GRIDS[..GRIDS.partition_point(affordable)].last().copied()?;
        Some(choice(model, Recipe { samples, ..recipe }, pixels))
    };
    let all = skeletons(caustics).filter_map(with_most_samples);
    all.min_by(|a, b| a.parts.total().value.total_cmp(&b.parts.total().value))
}

/// All recipes but for their eye rays.
fn skeletons(caustics: u64) -> impl Iterator<Item = Recipe> {
    let photons = levels(PHOTONS[0], PHOTONS[1]);
    let of_caustics = if caustics == 0 { vec![0] } else { levels(CAUSTICS.min(caustics), caustics) };
    DESIGNS.into_iter().flat_map(move |[gathers, light_samples]| {
        let of_caustics = of_caustics.clone();
        let maps = photons.clone().into_iter().flat_map(|photons| KS[PLANNED].iter().map(move |&k| (photons, k)));
        maps.flat_map(move |(photons, k)| {
            let recipe = Recipe { samples: 0, gathers, light_samples, photons, k, caustics: 0 };
            of_caustics.clone().into_iter().map(move |caustics| Recipe { caustics, ..recipe })
        })
    })
}

/// Numbers from the least to the most, about a factor of 1.6 apart: 1, 1.6, 2.5, 4, 6.3, 10 with two digits.
fn levels(least: u64, most: u64) -> Vec<u64> {
    let two_digits = |x: f64| {
        let unit = libm::pow(10.0, libm::floor(libm::log10(x)) - 1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "numbers of photons")]
        let rounded = (libm::round(x / unit) * unit) as u64;
        rounded
    };
    let mut levels = vec![];
    let mut level = least as f64;
    while level <= most as f64 * 1.001 {
        levels.push(two_digits(level).min(most));
        level *= libm::pow(10.0, 0.2);
    }
    levels
}

/// Numbers of eye rays that fill a grid.
static GRIDS: LazyLock<Vec<u32>> = LazyLock::new(|| {
    let mut all: Vec<u32> = vec![];
    while let Some(next) = Recipe::grid(all.last().map_or(0.0, |&last| f64::from(last) + 1.0)) {
        all.push(next);
    }
    all
});

/// The recipe with as few eye rays as will do.
fn least_samples(model: &Model, recipe: Recipe, pixels: f64, error: f64, errors: f64) -> Option<Choice> {
    let fails = |samples: &u32| {
        let total = model.predict(&Recipe { samples: *samples, ..recipe }).total();
        total.value + errors * libm::sqrt(total.spread.variance) > error * error
    };
    let samples = *GRIDS.get(GRIDS.partition_point(fails))?;
    Some(choice(model, Recipe { samples, ..recipe }, pixels))
}

fn choice(model: &Model, recipe: Recipe, pixels: f64) -> Choice {
    Choice { recipe, parts: model.predict(&recipe), cost: model.cost(&recipe, pixels) }
}

#[cfg(test)]
mod tests;
