//! All of it together: a survey, a choice, a trial of what was chosen, and the choice once more with what that taught.

use crate::choice::{Choice, Rival, choose};
use crate::estimate::Estimate;
use crate::model::{Model, Parts};
use crate::survey::{Effort, Survey};
use crate::task::{PlanError, Task};
use crate::trial::Trial;
use pm_sampling::student_quantile;

/// What is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// The largest error.
    pub error: f64,
    /// With what chance it shall hold.
    pub confidence: f64,
    /// How much is measured.
    pub effort: Effort,
}

/// A plan.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What was chosen, with its error as predicted.
    pub choice: Choice,
    /// The square of its error, as tried.
    pub error: Estimate,
    /// The same in parts.
    pub parts: Parts,
    /// Does it do, even at the upper bound?
    pub holds: bool,
    /// What came next.
    pub rival: Option<Rival>,
    /// The model, as corrected by trials.
    pub model: Model,
    /// All trials, in their order.
    pub trials: Vec<Tried>,
    /// Seconds of processor time that planning took.
    pub seconds: f64,
}

/// A recipe that was tried.
#[derive(Clone, Copy, Debug)]
pub struct Tried {
    /// What was chosen, with its error as predicted.
    pub choice: Choice,
    /// The square of its error, as tried.
    pub error: Estimate,
    /// Does it do, even at the upper bound?
    pub holds: bool,
}

/// Trials at most.
const TRIALS: u32 = 6;
/// Share of a large picture's pixels that a trial makes, each twice.
const SHARE_TRIED: f64 = 0.008;
/// By what share the bound may stay below what is wanted: less is not worth another trial.
const NEAR: f64 = 0.9;
/// Photons are traced for a survey at most.
const MOST_SURVEYED: u64 = 2_560_000;
/// Share of a render that a larger survey may take.
const WORTH: f64 = 0.03;

/// Plans a picture; `None` where no recipe will do.
///
/// # Errors
/// If nothing is seen or lit.
pub fn plan(task: &Task<'_>, wanted: &Wanted) -> Result<Result<Plan, Model>, PlanError> {
    let start = (task.clock)();
    let mut effort = wanted.effort;
    let (mut model, mut best);
    loop {
        let before = (task.clock)();
        model = Model::new(Survey::measure(task, effort)?);
        let took = (task.clock)() - before;
        // The interval a trial will have, by and large: that of so many pixels.
        let margin = student_quantile(2.0 * wanted.confidence - 1.0, f64::from(effort.pixels) / 4.0);
        best = choose(&model, task.pixels(), wanted.error, margin, task.caustics);
        // Extrapolated far beyond the largest map: a larger one is traced if that is cheap beside what is planned.
        let beyond = best.first().is_none_or(|choice| choice.recipe.photons > 2 * effort.photons);
        let cost = best.first().map_or(f64::INFINITY, |choice| choice.cost);
        if !beyond || effort.photons >= MOST_SURVEYED || took * 4.0 > cost * WORTH {
            break;
        }
        effort.photons *= 4;
    }
    let mut tried: Option<Plan> = None;
    let mut trials = vec![];
    let (surveyed, mut lessons) = (model.clone(), Lessons::default());
    for trial in 1..=TRIALS {
        let Some(&choice) = best.first() else { break };
        let found = Trial::run(task, &model, &choice.recipe, pixels_of_trials(task, wanted.effort), u64::from(trial))?;
        let predicted = model.predict(&choice.recipe);
        lessons.add(&surveyed.predict(&choice.recipe), &found);
        lessons.teach(&mut model);
        // What all trials together say counts too: the least of several is too good to be true.
        let bound = found.total.upper(wanted.confidence).max(model.predict(&choice.recipe).total().value);
        let goal = wanted.error * wanted.error;
        let plan = Plan {
            choice,
            error: found.total,
            parts: found.parts(&predicted),
            holds: bound <= goal,
            rival: rival(&best),
            model: model.clone(),
            trials: vec![],
            seconds: (task.clock)() - start,
        };
        trials.push(Tried { choice, error: plan.error, holds: plan.holds });
        let better = tried
            .as_ref()
            .is_none_or(|old| if plan.holds { !old.holds || plan.choice.cost < old.choice.cost } else { !old.holds });
        let done = plan.holds && bound >= goal * NEAR * NEAR;
        if better {
            tried = Some(plan);
        }
        if done {
            break;
        }
        let relative = libm::sqrt(found.total.spread.variance) / found.total.value.max(f64::MIN_POSITIVE);
        best = chosen_again(task, wanted, &model, relative);
    }
    let seconds = (task.clock)() - start;
    Ok(match tried {
        Some(plan) => Ok(Plan { model, seconds, trials, ..plan }),
        None => Err(model),
    })
}

/// Pixels of a trial: the larger the picture, the more are worth it.
fn pixels_of_trials(task: &Task<'_>, effort: Effort) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small share of the pixels")]
    let share = (task.pixels() * SHARE_TRIED) as u32;
    effort.pixels.max(share)
}

/// The choice with the relative spread that trials have, not that of surveys.
fn chosen_again(task: &Task<'_>, wanted: &Wanted, model: &Model, relative: f64) -> Vec<Choice> {
    let z = student_quantile(2.0 * wanted.confidence - 1.0, f64::from(wanted.effort.pixels) / 4.0);
    let error = wanted.error / libm::sqrt(1.0 + z * relative);
    choose(model, task.pixels(), error, 0.0, task.caustics)
}

/// What trials found of what a survey predicted, as shares of it.
#[derive(Default)]
struct Lessons {
    noise: Vec<f64>,
    bias: Vec<f64>,
}

impl Lessons {
    fn add(&mut self, predicted: &Parts, found: &Trial) {
        let noise = predicted.rays.value + predicted.photons.value;
        if noise > 0.0 && found.noise.value > 0.0 {
            self.noise.push((found.noise.value / noise).clamp(0.2, 10.0));
        }
        // Bias is corrected as far as the trial knows it: what is lost in noise corrects nothing.
        let (bias, doubt) = (predicted.bias.value, libm::sqrt(found.bias.spread.variance));
        if bias > 0.0 && doubt < bias {
            self.bias.push((found.bias.value / bias).clamp(0.2, 10.0));
        }
    }

    /// Corrects a model by all of them alike.
    fn teach(&self, model: &mut Model) {
        let mean = |shares: &[f64]| shares.iter().sum::<f64>() / shares.len() as f64;
        if !self.noise.is_empty() {
            model.noise = mean(&self.noise);
        }
        if !self.bias.is_empty() {
            model.bias = mean(&self.bias);
        }
    }
}

/// Who came next: another recipe, not the same with other eye rays.
fn rival(best: &[Choice]) -> Option<Rival> {
    best.get(1).copied().map(Rival::Dearer)
}
