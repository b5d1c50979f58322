//! `pm-plan`: says how little a picture needs.

mod args;
mod clock;
mod pilots;
mod refuse;
mod report;
mod traffic;

use crate::asked::Asked;
use crate::cli::{Program, Typed, create_output, refusal};
use crate::picture::caustics;
use crate::setting;
pub use args::Args;
use clap::CommandFactory as _;
use pilots::Pilots;
use pm_plan::{Effort, PlanError, SearchBytes, Task, Wanted, plan};
use pm_report::Format;
use report::Report;
use std::io::Write as _;
use std::path::Path;
use traffic::Chip;

/// Photons of caustics that are planned with at most.
const MOST_CAUSTICS: u64 = 2_000_000;

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
    let task = Task {
        scene: &loaded,
        camera: view,
        materials: &header.materials,
        caustics: caustics::photons(&loaded, MOST_CAUSTICS, args.seed),
        seed: args.seed,
        clock: &clock::own_seconds,
        search_bytes: search_bytes.as_ref().map(|of| of as &SearchBytes<'_>),
    };
    let effort = Effort { pixels: args.pixels, photons: args.pilot_photons };
    let wanted = Wanted { error: args.error, confidence: args.confidence, effort };
    let pixels = f64::from(size[0]) * f64::from(size[1]);
    let planned = plan(&task, &wanted).map_err(|error| match error {
        PlanError::Dark | PlanError::NothingSeen => refusal(error.to_string()),
        PlanError::Map(error) => error.into(),
        PlanError::Traffic(error) => anyhow::Error::from_boxed(error),
    })?;
    let plan = match planned {
        Ok(plan) if plan.holds => plan,
        Ok(plan) => return Err(refuse::error_out_of_reach(&args, &plan.model, pixels, task.caustics, Some(&plan))),
        Err(model) => return Err(refuse::error_out_of_reach(&args, &model, pixels, task.caustics, None)),
    };
    let fetched = chip.as_ref().map(|chip| chip.measure(&plan.choice.recipe)).transpose()?.unwrap_or_default();
    if let (Some(bandwidth), Some(least)) = (args.bandwidth, fetched.first())
        && least.bytes.upper(args.confidence) * args.fps > bandwidth
    {
        return Err(refuse::too_much(&args, &plan, least, bandwidth, pixels, task.caustics));
    }
    let own = clock::own_seconds() - started + clock::seconds_of_others() - others;
    let pilots = Pilots { scene: &scene, camera: &camera, size, threads: args.common.threads, seed: args.seed };
    let time = pilots.measure(&plan.choice, plan.model.times())?;
    if let Some(seconds) = args.seconds.filter(|&seconds| time.total.upper(args.confidence) > seconds) {
        return Err(refuse::too_slow(&args, &plan, &time, seconds, pixels, task.caustics));
    }
    let pipe = pilots.pasted(&plan.choice);
    let report = Report { args: &args, plan: &plan, time: &time, fetched: &fetched, own, pipe, size };
    let mut output = create_output(Path::new("-"))?;
    match args.format {
        Format::Table => output.write_all(report.text().as_bytes())?,
        format => report.table().write(format, &mut output)?,
    }
    output.commit()
}
