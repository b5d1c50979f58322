//! `pm-plan`: says how little a picture needs.

mod args;
mod chart;
mod flip;
mod pilots;
mod refuse;
mod report;
mod traffic;

use crate::asked::Asked;
use crate::cli::{Program, Progress, Typed, create_output, refusal};
use crate::clock;
use crate::picture::caustics;
use crate::setting;
pub use args::Args;
use clap::CommandFactory as _;
use pilots::Pilots;
use pm_light::transport::Surfaces;
use pm_plan::{Caustics, Effort, NoPlan, PAPERS_MAP, PlanError, SearchBytes, Task, Wanted, frontier_of_map, plan};
use pm_report::Format;
use report::{Report, root};
use std::io::Write as _;
use std::path::Path;
use traffic::Chip;

/// Photons of caustics that are planned with at most.
const MOST_CAUSTICS: u64 = 2_000_000;

/// A picture aims photons of caustics when it looks for them and when it traces them: in all so much more than to look.
const AIMED: f64 = 5.0 / 3.0;

/// The program.
#[must_use]
pub fn program() -> Program<Asked<Args>> {
    Program::new("pm-plan", Args::command(), Asked::read).that_may_refuse()
}

/// Does what was asked.
///
/// # Errors
/// If it was asked wrongly, the scene cannot be loaded, one of the programs fails, or nothing will do.
pub fn run(Asked { args, scene, camera }: Asked<Args>, _: &Typed) -> anyhow::Result<()> {
    let loaded = args.scene.load(&args.common)?;
    let view = args.scene.camera(&loaded, &args.camera, &args.common)?;
    refuse::paint_left_out(&args)?;
    let header = setting::header(&loaded);
    let started = clock::own_seconds();
    let size = view.size();
    let chip = args.on_chip.map(|room| Chip::new((&scene, &camera, size), args.seed, room)).transpose()?;
    let search_bytes = chip.as_ref().map(|chip| |k: u32, photons: u64| chip.search_bytes(k, photons));
    let others = clock::seconds_of_others();
    let surfaces = Surfaces::new(&loaded);
    let of_caustics = of_caustics(&surfaces, args.seed);
    let caustics = of_caustics.as_ref().map_or(0, |caustics| caustics.most);
    let progress = Progress::spinner(args.common.quiet);
    let doing = |what: &str| progress.tell(what);
    let task = Task {
        surfaces,
        camera: view,
        materials: &header.materials,
        caustics: of_caustics,
        seed: args.seed,
        clock: &clock::own_seconds,
        doing: &doing,
        search_bytes: search_bytes.as_ref().map(|of| of as &SearchBytes<'_>),
    };
    let effort = Effort { pixels: args.pixels, photons: args.pilot_photons };
    let wanted = Wanted { error: args.error, confidence: args.confidence, seconds: args.seconds, effort };
    let pixels = f64::from(size[0]) * f64::from(size[1]);
    let planned = plan(&task, &wanted).map_err(|error| match error {
        PlanError::Dark | PlanError::NothingSeen => refusal(error.to_string()),
        PlanError::Map(error) => error.into(),
        PlanError::Traffic(error) => anyhow::Error::from_boxed(error),
    })?;
    let plan = match planned {
        Ok(plan) if plan.holds => plan,
        Ok(plan) => return Err(refuse::error_out_of_reach(&args, &plan.model, pixels, caustics, Some(&plan))),
        Err(NoPlan { model, untried: None }) => {
            return Err(refuse::error_out_of_reach(&args, &model, pixels, caustics, None));
        }
        Err(NoPlan { model, untried: Some((choice, why)) }) => {
            return Err(refuse::untried(&args, &model, &choice, why, pixels, caustics));
        }
    };
    doing("bytes of orders");
    let fetched = chip.as_ref().map(|chip| chip.measure(&plan.choice.recipe)).transpose()?.unwrap_or_default();
    if let (Some(bandwidth), Some(least)) = (args.bandwidth, fetched.first())
        && least.bytes.upper(args.confidence) * args.fps > bandwidth
    {
        return Err(refuse::too_much(&args, &plan, least, bandwidth, pixels, caustics));
    }
    let own = clock::own_seconds() - started + clock::seconds_of_others() - others;
    let pilots = Pilots { scene: &scene, camera: &camera, size, threads: args.common.threads, seed: args.seed };
    doing("time, by small pictures");
    let time = pilots.measure(&plan.choice, plan.model.times())?;
    if time.total.upper(args.confidence) > args.seconds {
        return Err(refuse::too_slow(&args, &plan, &time, pixels, caustics));
    }
    let before = clock::seconds_of_others();
    if args.flip {
        doing("FLIP, by small pictures");
    }
    let flip = args.flip.then(|| flip::measure(&pilots, &plan.choice.recipe)).transpose()?;
    let own = own + clock::seconds_of_others() - before;
    drop(progress);
    let pipe = pilots.pasted(&plan.choice);
    let usual = frontier_of_map(&plan.model, pixels, &[root(plan.error.value)], caustics, PAPERS_MAP).first().copied();
    let report = Report { args: &args, plan: &plan, time: &time, fetched: &fetched, flip, usual, own, pipe, size };
    if let Some(path) = &args.chart {
        let mut drawing = create_output(path)?;
        drawing.write_all(chart::svg(&plan, (args.error, args.confidence), pixels, caustics)?.as_bytes())?;
        drawing.commit()?;
    }
    let mut output = create_output(Path::new("-"))?;
    match args.format {
        Format::Table => output.write_all(report.text().as_bytes())?,
        format => report.table().write(format, &mut output)?,
    }
    output.commit()
}

/// Light that mirrors and glass focus.
fn of_caustics<'a>(surfaces: &Surfaces<'a>, seed: u64) -> Option<Caustics<'a>> {
    let before = clock::own_seconds();
    let (most, paths) = caustics::found(surfaces, MOST_CAUSTICS, seed)?;
    Some(Caustics { most, paths, aiming: AIMED * (clock::own_seconds() - before) })
}
