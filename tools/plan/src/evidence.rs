//! What trials taught, all of them together: a recipe that was tried until it passed would be too good to be true.

use crate::estimate::Estimate;
use crate::model::{Model, Parts};
use crate::recipe::Recipe;
use crate::trial::Trial;
use pm_sampling::Spread;

/// A survey, and trials of what it predicted.
pub(crate) struct Evidence {
    surveyed: Model,
    trials: Vec<Tried>,
}

/// One recipe tried.
struct Tried {
    recipe: Recipe,
    /// By the survey alone.
    predicted: Parts,
    found: Trial,
}

/// By how much a prediction may be corrected.
const CORRECTIONS: std::ops::RangeInclusive<f64> = 0.2..=10.0;

impl Evidence {
    /// No trial yet.
    pub(crate) const fn new(surveyed: Model) -> Self {
        Self { surveyed, trials: vec![] }
    }

    /// Adds the trial of a recipe.
    pub(crate) fn add(&mut self, recipe: &Recipe, found: Trial) {
        let predicted = self.surveyed.predict(recipe);
        self.trials.push(Tried { recipe: *recipe, predicted, found });
    }

    /// The model corrected by all trials alike.
    pub(crate) fn model(&self) -> Model {
        let mut model = self.surveyed.clone();
        let mean = |shares: Vec<f64>| (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64);
        let correction =
            |found: f64, predicted: f64| (found / predicted).clamp(*CORRECTIONS.start(), *CORRECTIONS.end());
        let noise = |Tried { predicted, found, .. }: &Tried| {
            let noise = predicted.rays.value + predicted.photons.value;
            (noise > 0.0 && found.noise.value > 0.0).then(|| correction(found.noise.value, noise))
        };
        // Bias is corrected as far as the trial knows it: what is lost in noise corrects nothing.
        let bias = |Tried { predicted, found, .. }: &Tried| {
            let (bias, doubt) = (predicted.bias.value, libm::sqrt(found.bias.spread.variance));
            (bias > 0.0 && doubt < bias).then(|| correction(found.bias.value, bias))
        };
        if let Some(noise) = mean(self.trials.iter().filter_map(noise).collect()) {
            model.noise = noise;
        }
        if let Some(bias) = mean(self.trials.iter().filter_map(bias).collect()) {
            model.bias = bias;
        }
        model
    }

    /// The square of the error that a run of a recipe will have: the spread is of what trials leave in doubt, and of what differs
    /// from run to run.
    ///
    /// The corrected model speaks for every recipe, with the doubt of all trials and that of recipes being different; trials of the
    /// recipe itself, if there are any, count beside it by what they know.
    pub(crate) fn judge(&self, recipe: &Recipe) -> Estimate {
        let model = self.model();
        let predicted = model.predict(recipe).total().value;
        let all = Known::of(self.trials.iter().map(|one| &one.found));
        let of_model =
            Known { value: predicted, doubt: Spread { variance: all.doubt.variance + self.discord(), ..all.doubt } };
        let own: Vec<&Trial> = self.trials.iter().filter(|one| one.recipe == *recipe).map(|one| &one.found).collect();
        let known = if own.is_empty() { of_model } else { of_model.with(&Known::of(own.iter().copied())) };
        // What differs from run to run is of one run, however many trials there were.
        let runs =
            self.trials.iter().map(|one| one.found.relative(one.found.run)).fold(Spread::default(), Spread::plus);
        let run = Spread { variance: runs.variance / self.trials.len().max(1) as f64, ..runs };
        Estimate { value: known.value, spread: known.doubt.plus(run).scaled(known.value).plus(model.lumps(recipe)) }
    }

    /// By how much trials differ from what was predicted, each its own way: the relative variance, beyond what they do not know.
    fn discord(&self) -> f64 {
        let n = self.trials.len() as f64;
        let share = |one: &Tried| one.found.total.value / one.predicted.total().value.max(f64::MIN_POSITIVE);
        let mean = self.trials.iter().map(share).sum::<f64>() / n;
        let apart = self.trials.iter().map(|one| libm::pow(share(one) / mean - 1.0, 2.0)).sum::<f64>() / (n - 1.0);
        let noise = self.trials.iter().map(|one| Known::of([&one.found]).doubt.variance).sum::<f64>() / n;
        let usual = USUAL_DISCORD * USUAL_DISCORD;
        if n > 1.0 { f64::midpoint(usual, (apart - noise).max(0.0)) } else { usual }
    }
}

/// What is thought of the model's errors before there are trials: a tenth of the squared error.
const USUAL_DISCORD: f64 = 0.1;

/// A squared error, and the spread of what is known of it, relative to it.
struct Known {
    value: f64,
    doubt: Spread,
}

impl Known {
    /// The mean of trials.
    fn of<'a>(trials: impl IntoIterator<Item = &'a Trial>) -> Self {
        let trials: Vec<&Trial> = trials.into_iter().collect();
        let n = trials.len().max(1) as f64;
        Self {
            value: trials.iter().map(|trial| trial.total.value).sum::<f64>() / n,
            doubt: trials
                .iter()
                .map(|trial| trial.relative(trial.total.spread))
                .fold(Spread::default(), Spread::plus)
                .scaled(1.0 / n),
        }
    }

    /// Both together, each by how well it knows.
    fn with(self, other: &Self) -> Self {
        let sure = |one: &Self| 1.0 / one.doubt.variance.max(1e-9);
        let (a, b) = (sure(&self), sure(other));
        let doubt = Spread { variance: 1.0 / (a + b), freedom: self.doubt.freedom.min(other.doubt.freedom) };
        Self { value: (a * self.value + b * other.value) / (a + b), doubt }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::DESIGNS;
    use crate::survey::{KS, Layer, Survey};

    /// Of rays alone, with an error of 0.1 by 4 eye rays.
    fn surveyed() -> Model {
        let known = |value: f64| Estimate { value, ..Estimate::default() };
        let none = || vec![known(0.0); KS.len()];
        let soft = Layer { rays: none(), photons: none(), lumps: vec![0.0; KS.len()], ..Layer::default() };
        Model::new(Survey { soft, rays: [known(0.01); DESIGNS.len()], ..Survey::default() })
    }

    const RECIPE: Recipe = Recipe { samples: 4, gathers: 4, light_samples: 4, photons: 1000, k: 10, caustics: 0 };

    fn found(square: f64, relative: f64) -> Trial {
        let spread = Spread { variance: libm::pow(relative * square, 2.0), freedom: 100.0 };
        let total = Estimate { value: square, spread };
        Trial { noise: total, bias: Estimate::default(), total, run: Spread::default() }
    }

    #[test]
    fn what_trials_find_corrects_all_recipes() {
        let mut evidence = Evidence::new(surveyed());
        evidence.add(&RECIPE, found(0.02, 0.001));
        let other = Recipe { samples: 16, ..RECIPE };
        let judged = evidence.judge(&other);
        assert!((judged.value - 0.005).abs() < 1e-9, "{judged:?}");
        // One that was not tried itself stays in doubt by a tenth.
        assert!((libm::sqrt(judged.spread.variance) / judged.value - USUAL_DISCORD).abs() < 0.001);
        let own = evidence.judge(&RECIPE);
        assert!((own.value - 0.02).abs() < 1e-6 && libm::sqrt(own.spread.variance) / own.value < 0.002);
    }

    #[test]
    fn one_lucky_trial_of_many_is_not_believed() {
        let mut evidence = Evidence::new(surveyed());
        for samples in [6, 9, 12] {
            evidence.add(&Recipe { samples, ..RECIPE }, found(0.04 / f64::from(samples), 0.1));
        }
        // As predicted three times; now a quarter better, by chance of the same size.
        evidence.add(&RECIPE, found(0.0075, 0.1));
        let judged = evidence.judge(&RECIPE);
        assert!((0.0082..0.0092).contains(&judged.value), "{judged:?}");
        // A trial that knows better is believed.
        evidence.add(&RECIPE, found(0.0075, 0.01));
        assert!(evidence.judge(&RECIPE).value < 0.0078, "{:?}", evidence.judge(&RECIPE));
    }
}
