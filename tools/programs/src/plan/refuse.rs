//! What is not planned, why, and what could be instead.

use super::args::Args;
use super::pilots::Time;
use super::report::{percent, root};
use super::traffic::Fetched;
use crate::cli::{Common, refusal, usage};
use crate::setting::SceneArgs;
use pm_light::scene::MaterialKind;
use pm_plan::{Choice, Model, Plan, Untried, nearest_in};

/// Refuses a scene whose glossy lobes are left out without a word: its picture would be planned well and be another scene's.
pub(super) fn paint_left_out(args: &Args) -> anyhow::Result<()> {
    if args.scene.glossy || args.anyway || args.scene.scene.is_empty() {
        return Ok(());
    }
    let glossy = SceneArgs { glossy: true, verbose: false, ..args.scene.clone() };
    let loaded = glossy.load(&Common { quiet: true, ..args.common })?;
    let plain = SceneArgs { verbose: false, ..args.scene.clone() }.load(&Common { quiet: true, ..args.common })?;
    let lost = loaded
        .materials
        .iter()
        .zip(&plain.materials)
        .find(|(with, without)| with.kind == MaterialKind::Glossy && without.kind != MaterialKind::Glossy);
    match lost {
        None => Ok(()),
        Some((material, _)) => Err(refusal(format!(
            "material {:?} has Ks and Ns, which are left out: the plan would be that of a duller scene; say --glossy to take \
             them, or --anyway if they are not meant",
            material.name
        ))),
    }
}

/// No recipe has so little error.
pub(super) fn error_out_of_reach(
    args: &Args,
    model: &Model,
    pixels: f64,
    caustics: u64,
    tried: Option<&Plan>,
) -> anyhow::Error {
    let wanted = percent(args.error);
    if let Some(plan) = tried {
        let upper = percent(root(plan.bound));
        return refusal(format!(
            "--error {wanted}: what should do does not when it is tried: {} at {} (bound {upper} at {} confidence); the pilots see \
             too little of what is rare here; try --error {upper}, or more --pixels",
            super::report::recipe(&plan.choice.recipe),
            percent(root(plan.error.value)),
            percent(args.confidence),
        ));
    }
    // As long as somebody might wait.
    const HOURS: f64 = 10.0 * 3600.0;
    match nearest_in(&model.by_time(), pixels, HOURS, caustics) {
        Some(near) => refusal(format!(
            "--error {wanted}: no recipe that is planned with has so little error with a confidence of {}; nearest is {} by {} \
             in {:.0} s of processor time",
            percent(args.confidence),
            percent(root(near.parts.total().value)),
            super::report::recipe(&near.recipe),
            near.cost
        )),
        None => usage("the picture is too large to be planned: ask for a smaller --size"),
    }
}

/// Refuses with the nearest that can be had `with` less; its bound is as far above its error as that of the plan is.
fn nearest(needed: &str, with: &str, plan: &Plan, other: Option<Choice>) -> anyhow::Error {
    let Some(near) = other else {
        return refusal(format!("{needed}; nothing that is planned with does {with}"));
    };
    let margin = plan.bound / plan.error.value.max(f64::MIN_POSITIVE);
    refusal(format!(
        "{needed}; nearest {with} is an error of at most {}, by {}",
        percent(root(near.parts.total().value * margin)),
        super::report::recipe(&near.recipe)
    ))
}

/// The order that fetches least fetches too much.
pub(super) fn too_much(
    args: &Args,
    plan: &Plan,
    least: &Fetched,
    bandwidth: f64,
    pixels: f64,
    caustics: u64,
) -> anyhow::Error {
    let upper = least.bytes.upper(args.confidence) * args.fps;
    let needed = format!(
        "--bandwidth: an error of {} takes {} a second, {}",
        percent(args.error),
        super::report::bytes(upper),
        least.order
    );
    // What fewer rays fetch, by the share that these do.
    let budget = plan.choice.cost * bandwidth / upper;
    nearest(&needed, "with that", plan, nearest_in(&plan.model, pixels, budget, caustics))
}

/// The cheapest recipe takes too long.
pub(super) fn too_slow(args: &Args, plan: &Plan, time: &Time, pixels: f64, caustics: u64) -> anyhow::Error {
    let upper = time.total.upper(args.confidence);
    let needed = format!("--seconds {}: an error of {} takes {upper:.1} s", args.seconds, percent(args.error));
    // The model's seconds are those of its parts; the pilots say what they come to in pipes, at most.
    let budget = args.seconds * plan.choice.cost / upper;
    nearest(&needed, "in that time", plan, nearest_in(&plan.model, pixels, budget, caustics))
}

/// What would do by the survey was not even tried.
pub(super) fn untried(
    args: &Args,
    model: &Model,
    choice: &Choice,
    why: Untried,
    pixels: f64,
    caustics: u64,
) -> anyhow::Error {
    let recipe = super::report::recipe(&choice.recipe);
    let (wanted, takes) = (percent(args.error), model.times().of(&choice.recipe, pixels));
    if let Untried::TrialTooSlow(trying) = why {
        return refusal(format!(
            "--error {wanted}: by the survey {recipe} would do in some {takes:.0} s of processor time, but to try that would take \
             {trying:.0} s, and nothing is promised untried; try a larger --error, or a larger --size for which it is worth it"
        ));
    }
    let near = nearest_in(&model.by_time(), pixels, args.seconds, caustics);
    let near = near.map_or_else(
        || "nothing that is planned with does in that time".to_owned(),
        |near| {
            let error = percent(root(near.parts.total().value));
            format!("nearest in that time is an error of about {error}, by {}", super::report::recipe(&near.recipe))
        },
    );
    refusal(format!(
        "--seconds {}: an error of {wanted} takes some {takes:.0} s of processor time, by the survey; {near}",
        args.seconds
    ))
}
