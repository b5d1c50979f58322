//! One recipe measured as a whole, with random numbers that nobody has chosen by.

use crate::answers::{Asking, Map};
use crate::model::Model;
use crate::pixels::Pixels;
use crate::preview::Preview;
use crate::rays::{Design, cast};
use crate::recipe::Recipe;
use crate::replicates::{Values, Weights, mean, sum};
use crate::survey::KS;
use crate::task::{Caustics, PlanError, Task};
use crate::times::Times;
use crate::traced::Traced;
use pm_gathering::Kernel;
use pm_light::transport::PhotonPaths;
use pm_sampling::Spread;

/// What a trial found.
pub(crate) struct Trial {
    /// Noise, of rays and photons together.
    pub(crate) noise: crate::Estimate,
    /// The square of the bias.
    pub(crate) bias: crate::Estimate,
    /// Noise and bias together.
    pub(crate) total: crate::Estimate,
    /// How much the rays of a whole picture make that differ from run to run.
    pub(crate) run: Spread,
}

/// One of two pictures of the same pixels: as the recipe has it, and with as little blur as can be had.
#[derive(Default)]
struct Replicate {
    pixels: Values,
    sharp: Values,
}

impl Replicate {
    /// The difference between both made larger: the square of the difference is to be multiplied by `of_square` to be that to no
    /// blur at all.
    fn extrapolated(self, of_square: f64) -> Self {
        let factor = libm::sqrt(of_square);
        let far = |(pixel, sharp): (&[f64; 3], &[f64; 3])| [0, 1, 2].map(|c| pixel[c] + factor * (sharp[c] - pixel[c]));
        let sharp = self.pixels.iter().zip(&self.sharp).map(far).collect();
        Self { sharp, ..self }
    }

    fn plus(&self, other: &Self) -> Self {
        Self { pixels: sum(&self.pixels, &other.pixels), sharp: sum(&self.sharp, &other.sharp) }
    }
}

/// Photons of the map that blur is measured against, at most, unless the recipe has more.
const MOST_REFERENCE: u64 = 1_000_000;
/// The same beside a large picture.
const MOST_BESIDE: u64 = 250_000;

impl Trial {
    /// A spread of it, relative to its error.
    pub(crate) fn relative(&self, spread: Spread) -> Spread {
        spread.scaled(1.0 / self.total.value.max(f64::MIN_POSITIVE))
    }

    /// Makes some pixels of the picture twice and compares them.
    pub(crate) fn run(
        task: &Task<'_>,
        preview: &Preview,
        model: &Model,
        recipe: &Recipe,
        number: u32,
        round: u64,
    ) -> Result<Self, PlanError> {
        let pixels = Pixels::choose(preview, number, task.seed_of(6, round));
        let [(more, finer), finer_caustics] = sharper(recipe, task.is_large());
        let soft = |r: u64| -> Result<Replicate, PlanError> {
            let Recipe { samples, gathers, light_samples, .. } = *recipe;
            let design = Design { samples, gathers, light_samples };
            let options = design.soft(task.seed_of(7 + r, round), task.caustics.is_some());
            let set = cast(&task.surfaces, task.camera, &pixels.at, options);
            let mut traced = Traced::new(PhotonPaths::new(task.surfaces.clone(), task.seed_of(9 + r, round)));
            let asking = Asking { materials: task.materials, kernel: Kernel::Constant };
            let mut ask = |n: u64, k: u32| -> Result<Values, PlanError> {
                let map = Map::build(traced.first(n).ok_or(PlanError::Dark)?, asking, &[k])?;
                Ok(sum(&set.light, &map.values(&set).remove(0)))
            };
            Ok(Replicate { pixels: ask(recipe.photons, recipe.k)?, sharp: ask(more, finer)? })
        };
        let caustics = |light: &Caustics<'_>, r: u64| -> Result<Replicate, PlanError> {
            let set =
                cast(&task.surfaces, task.camera, &pixels.at, Design::seen(recipe.seen(), task.seed_of(11 + r, round)));
            let mut traced = Traced::new(light.paths.with_seed(task.seed_of(13 + r, round)));
            let asking = Asking { materials: task.materials, kernel: Kernel::Cone };
            let mut ask = |n: u64, k: u32| -> Result<Values, PlanError> {
                let map = Map::build(traced.first(n).ok_or(PlanError::Dark)?, asking, &[k])?;
                Ok(map.values(&set).remove(0))
            };
            let (more, finer) = finer_caustics;
            Ok(Replicate { pixels: ask(recipe.caustics, Times::CAUSTICS_K)?, sharp: ask(more, finer)? })
        };
        let survey = &model.survey;
        let share = |(photons, k): (u64, u32)| f64::from(k) / photons as f64;
        let soft_blur = survey.soft.bias.extrapolation(recipe.share(), share((more, finer)));
        let mut both = [0, 1].map(|_| Replicate::default());
        for (one, r) in both.iter_mut().zip(0..) {
            let found = soft(r)?.extrapolated(soft_blur);
            *one = match (&survey.caustics, &task.caustics) {
                (Some(layer), Some(light)) if recipe.caustics > 0 => {
                    let whole = share((recipe.caustics, Times::CAUSTICS_K));
                    let blur = layer.bias.extrapolation(whole, share(finer_caustics));
                    found.plus(&caustics(light, r)?.extrapolated(blur))
                }
                _ => found,
            };
        }
        let mut found = Self::compare(&both, &pixels);
        // What the pixels do not know: two maps are two of many.
        let seen = found.total.spread;
        found.total.spread = seen.plus(model.lumps(recipe));
        found.run = Spread { variance: seen.variance * pixels.len() as f64 / task.pixels(), ..seen };
        Ok(found)
    }

    fn compare([a, b]: &[Replicate; 2], pixels: &Pixels) -> Self {
        let weights = Weights::of(&mean([&a.sharp, &b.sharp])).times(&pixels.stand_for);
        let half = |x: f64| x / 2.0;
        let noise = weights.products([&a.pixels, &b.pixels], [&a.pixels, &b.pixels]).into_iter().map(half);
        let bias = weights.products([&a.pixels, &a.sharp], [&b.pixels, &b.sharp]);
        let noise: Vec<f64> = noise.collect();
        let total: Vec<f64> = noise.iter().zip(&bias).map(|(noise, bias)| noise + bias).collect();
        Self {
            noise: crate::Estimate::mean(&noise),
            bias: crate::Estimate::mean(&bias),
            total: crate::Estimate::mean(&total),
            run: Spread::default(),
        }
    }
}

/// Photons and neighbours that blur less: of all photons, and of caustics.
///
/// Beside a large picture whole traces of four times the photons would be dear, most of all of caustics, each of which takes as long
/// as several others: there half the neighbours have to do.
fn sharper(recipe: &Recipe, large: bool) -> [(u64, u32); 2] {
    let (times, most) = if large { (2, MOST_BESIDE) } else { (4, MOST_REFERENCE) };
    let more = (times * recipe.photons).min(most).max(recipe.photons);
    let finer = if recipe.k > KS[0] || more > recipe.photons { KS[0].min(recipe.k) } else { recipe.k - 2 };
    let of_caustics =
        if large { (recipe.caustics, Times::CAUSTICS_K / 2) } else { (times * recipe.caustics, Times::CAUSTICS_K) };
    [(more, finer), of_caustics]
}
