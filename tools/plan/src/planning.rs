//! All of it together: a survey, a choice, a trial of what was chosen, and the choice once more with what that taught.

use crate::choice::{Choice, Rival, choose};
use crate::estimate::Estimate;
use crate::evidence::Evidence;
use crate::model::{Model, Parts};
use crate::preview::Preview;
use crate::recipe::Recipe;
use crate::survey::{Effort, Survey};
use crate::task::{PlanError, Task};
use crate::traffic::Traffic;
use crate::trial::Trial;
use pm_sampling::student_quantile;

/// What is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// The largest error.
    pub error: f64,
    /// With what chance it shall hold.
    pub confidence: f64,
    /// Seconds of processor time that the picture may take.
    pub seconds: f64,
    /// How much is measured.
    pub effort: Effort,
}

impl Wanted {
    /// The chance that is planned with: of several recipes that are tried, the one with the best luck is taken.
    fn surer(&self) -> f64 {
        1.0 - (1.0 - self.confidence) / LOOKS
    }
}

/// A plan.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What was chosen, with its error as predicted.
    pub choice: Choice,
    /// The square of the error that a run will have, by all trials together.
    pub error: Estimate,
    /// The same in parts.
    pub parts: Parts,
    /// What that square is at most, with the chance that was wanted and the luck of several tries allowed for.
    pub bound: f64,
    /// Is that no more than was wanted?
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
    /// The square of its error, as this trial found it.
    pub error: Estimate,
}

/// Trials at most.
const TRIALS: u32 = 6;
/// Recipes that are much alike are tried until one will do: about so many times luck has a chance.
const LOOKS: f64 = 3.0;
/// What would cost more than this share of what will do is not tried.
const LITTLE: f64 = 0.8;
/// Where half the trials have not found what will do, each of the others asks for so much less error; of a large picture each does.
const STRICTER: f64 = 0.94;
/// Pixels that a trial makes, each twice: times those of a survey, and as a share of a large picture's.
const MORE_TRIED: u32 = 4;
const SHARE_TRIED: f64 = 0.004;
/// Fewer say nothing.
const LEAST_TRIED: f64 = 16.0;
/// The survey's seconds are those of parts, and may be off by so much.
const BY_FAR: f64 = 1.5;
/// Seconds that a trial may take however little the picture takes, and as a share of the picture's; each pixel is made twice, with
/// two maps.
const LONG: f64 = 20.0;
const SHARE_OF_TIME: f64 = 0.02;
const TIMES_MADE: f64 = 3.0;
/// Trials may take so many seconds, or this share of the picture's: what none has shown by then is not promised.
const PATIENCE: (f64, f64) = (120.0, 0.2);
/// Beside a large picture planning may take this share of its seconds to find one that is cheaper still.
const ALLOWED: f64 = 0.07;
/// Gather rays of a trial's pixels that there is memory for: a gigabyte.
const MOST_RAYS: f64 = 16e6;
/// Photons are traced for a survey at most.
const MOST_SURVEYED: u64 = 2_560_000;
/// Share of a render that a larger survey may take.
const WORTH: f64 = 0.03;

/// What is known where there is no plan.
#[derive(Clone, Debug)]
pub struct NoPlan {
    /// What pictures cost here.
    pub model: Model,
    /// What would do by the survey alone, and why it is not promised; none where nothing does.
    pub untried: Option<(Choice, Untried)>,
}

/// Why a recipe was not tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Untried {
    /// The picture would take far more time than it may.
    TooSlow,
    /// A trial would take so many seconds, far more than it is worth beside the picture.
    TrialTooSlow(f64),
}

/// Plans a picture.
///
/// # Errors
/// If nothing is seen or lit.
pub fn plan(task: &Task<'_>, wanted: &Wanted) -> Result<Result<Plan, NoPlan>, PlanError> {
    let start = (task.clock)();
    (task.doing)("edges of lamps");
    let preview = Preview::of(task);
    let (model, mut best) = surveyed(task, wanted, &preview)?;
    // Trials of it would take hours themselves. It may only be that a survey knows little of so small an error: what does by its
    // estimate without the interval is tried, if that is fast enough.
    let too_slow =
        |choice: &Choice, by_far: f64| model.times().of(&choice.recipe, task.pixels()) > by_far * wanted.seconds;
    if let Some(&choice) = best.first().filter(|best| too_slow(best, BY_FAR)) {
        best = choose(&model, task.pixels(), wanted.error, 0.0, task.most_caustics());
        if best.first().is_none_or(|hoped| too_slow(hoped, 1.0)) {
            return Ok(Err(NoPlan { model, untried: Some((choice, Untried::TooSlow)) }));
        }
    }
    let bound = |error: &Estimate| error.upper(wanted.surer());
    let does = |error: &Estimate| bound(error) <= wanted.error * wanted.error;
    let model_of_time = model.times().clone();
    let mut evidence = Evidence::new(model);
    let mut trials: Vec<Tried> = vec![];
    let mut too_dear = None;
    for trial in 1..=TRIALS {
        let Some(&choice) = best.first() else { break };
        let takes = model_of_time.of(&choice.recipe, task.pixels());
        let pixels = pixels_of_trials(task, wanted.effort, takes, &choice.recipe);
        // Photons of both maps are traced whole, however few pixels are made.
        let of_photons = model_of_time.of(&choice.recipe, 0.0);
        let trying = 2.0 * of_photons + TIMES_MADE * f64::from(pixels) * (takes - of_photons) / task.pixels();
        let spent = if trials.is_empty() { 0.0 } else { (task.clock)() - start };
        if spent + trying > PATIENCE.0.max(PATIENCE.1 * takes) {
            too_dear = trials.is_empty().then_some((choice, Untried::TrialTooSlow(trying)));
            break;
        }
        let one_does = trials.iter().any(|tried| does(&evidence.judge(&tried.choice.recipe)));
        if one_does && task.is_large() && spent + trying > ALLOWED * takes {
            break;
        }
        (task.doing)(&format!("trial {trial} of {TRIALS} at most, on {pixels} pixels"));
        let found = Trial::run(task, &preview, &evidence.model(), &choice.recipe, pixels, u64::from(trial))?;
        trials.push(Tried { choice, error: found.total });
        evidence.add(&choice.recipe, found);
        let tried = |next: &Choice| trials.iter().any(|tried| tried.choice.recipe == next.recipe);
        // Each trial of a large picture is dear.
        let patient = if task.is_large() { 0 } else { TRIALS / 2 };
        let strict = libm::pow(STRICTER, f64::from(trial.saturating_sub(patient)));
        best = chosen_again(task, &Wanted { error: wanted.error * strict, ..*wanted }, &evidence, &choice.recipe);
        best.retain(|next| !tried(next) || does(&evidence.judge(&next.recipe)));
        // What would be tried next has been, or saves little beside what will do: there is no more to learn that is worth it.
        let dear = |next: &Choice| {
            let mut doing = trials.iter().filter(|tried| does(&evidence.judge(&tried.choice.recipe)));
            doing.any(|tried| next.cost > LITTLE * tried.choice.cost)
        };
        if best.first().is_some_and(|next| tried(next) || dear(next)) {
            break;
        }
    }
    let (model, seconds) = (evidence.model(), (task.clock)() - start);
    let judged = |tried: &Tried| (tried.choice, evidence.judge(&tried.choice.recipe));
    let mut tried: Vec<(Choice, Estimate)> = trials.iter().map(judged).collect();
    // The cheapest of those that will do; else the one with the least error.
    tried.sort_by(|a, b| a.0.cost.total_cmp(&b.0.cost));
    let least = tried.iter().min_by(|a, b| a.1.value.total_cmp(&b.1.value));
    Ok(match tried.iter().find(|(_, error)| does(error)).or(least) {
        Some(&(choice, error)) => Ok(Plan {
            choice,
            error,
            parts: model.predict(&choice.recipe),
            bound: bound(&error),
            holds: does(&error),
            rival: rival(&best, &choice.recipe),
            model,
            trials,
            seconds,
        }),
        None => Err(NoPlan { model, untried: too_dear }),
    })
}

/// A survey, and what is to be tried by it, the cheapest first.
fn surveyed(task: &Task<'_>, wanted: &Wanted, preview: &Preview) -> Result<(Model, Vec<Choice>), PlanError> {
    if task.search_bytes.is_some() {
        (task.doing)("bytes of searches, by photons and neighbours");
    }
    let traffic = task.search_bytes.map(Traffic::measure).transpose().map_err(PlanError::Traffic)?;
    let mut effort = if task.is_large() { wanted.effort.halved() } else { wanted.effort };
    loop {
        (task.doing)(&format!("survey of {} pixels, with {} photons", effort.pixels, effort.photons));
        let before = (task.clock)();
        let model = Model::new(Survey { traffic: traffic.clone(), ..Survey::measure(task, preview, effort)? });
        let took = (task.clock)() - before;
        // The interval a trial will have, by and large: that of so many pixels.
        let margin = student_quantile(2.0 * wanted.surer() - 1.0, f64::from(effort.pixels) / 4.0);
        let best = choose(&model, task.pixels(), wanted.error, margin, task.most_caustics());
        let takes = |choice: &Choice| model.times().of(&choice.recipe, task.pixels());
        let cost = best.first().map_or(f64::INFINITY, takes).min(wanted.seconds);
        // What was halved is made whole, and where it is extrapolated far beyond the largest map a larger one is traced, if that is
        // cheap beside what is planned.
        let beyond = best.first().is_none_or(|choice| choice.recipe.photons > 2 * effort.photons);
        if took * 4.0 > cost * WORTH {
            return Ok((model, best));
        } else if effort.pixels < wanted.effort.pixels {
            effort = wanted.effort;
        } else if beyond && effort.photons < MOST_SURVEYED {
            effort.photons *= 4;
        } else {
            return Ok((model, best));
        }
    }
}

/// Pixels of a trial: the larger the picture, the more are worth it; but neither more time than that nor more memory than there
/// may be, or a picture that takes hours would be planned for days.
fn pixels_of_trials(task: &Task<'_>, effort: Effort, seconds: f64, recipe: &Recipe) -> u32 {
    let of_picture = task.pixels();
    let wanted = (of_picture * SHARE_TRIED).max(f64::from(MORE_TRIED * effort.pixels));
    let rays = f64::from(recipe.samples) * f64::from(recipe.gathers);
    let budget = LONG.max(seconds * SHARE_OF_TIME);
    let affordable = (budget * of_picture / (TIMES_MADE * seconds.max(f64::MIN_POSITIVE))).min(MOST_RAYS / rays);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "fewer than a picture has")]
    let pixels = wanted.min(affordable).max(LEAST_TRIED) as u32;
    pixels
}

/// The choice with the relative spread that trials leave, not that of surveys.
fn chosen_again(task: &Task<'_>, wanted: &Wanted, evidence: &Evidence, last: &Recipe) -> Vec<Choice> {
    let judged = evidence.judge(last);
    let margin = judged.upper(wanted.surer()) / judged.value.max(f64::MIN_POSITIVE);
    choose(&evidence.model(), task.pixels(), wanted.error / libm::sqrt(margin.max(1.0)), 0.0, task.most_caustics())
}

/// Who came next: another recipe, not the same with other eye rays.
fn rival(best: &[Choice], chosen: &Recipe) -> Option<Rival> {
    let same = |other: &Recipe| Recipe { samples: 0, ..*other } == Recipe { samples: 0, ..*chosen };
    best.iter().find(|other| !same(&other.recipe)).copied().map(Rival::Dearer)
}
