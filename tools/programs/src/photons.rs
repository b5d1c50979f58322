//! `pm-photons`: traces photons from the lights of a scene and writes those stored at its surfaces.

mod args;
mod collect;
pub(crate) mod part;

pub use args::Args;

use crate::cli::{Progress, Typed, usage};
use crate::setting::header;
use anyhow::ensure;
use collect::{Collected, Traced};
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{BlockMeta, Number, StageReport};
use pm_light::scene::Scene;
use pm_light::transport::PhotonPaths;
use pm_parallel::in_order;
use std::cell::RefCell;

/// Paths traced as one piece of work.
pub(crate) const PATHS: u64 = 4096;
/// Paths after which a scene that has stored nothing is given up.
const HOPELESS: u64 = 1 << 22;

/// Does what was asked.
///
/// # Errors
/// If it was asked wrongly, the scene cannot be loaded or stores no photon, or the output cannot be written.
pub fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    if args.number == 0 && !args.scene.verbose {
        return Err(usage("-n 0 stores no photon: give at least 1, or -v to see the materials alone"));
    }
    let scene = args.scene.load(&args.common)?;
    let mut header = header(&scene);
    header.expected_records = Some(args.number);
    header.history.push(typed.step(Some(args.seed)));
    if args.caustics {
        header.set_meaning(meaning::PHOTONS, meaning::CAUSTICS);
    }
    if let Some(part) = args.part {
        return part::trace(part, &args, &scene, header, typed);
    }
    let mut output = args.output.begin(&header)?;
    let progress = Progress::new(header.expected_records, "photons", args.common.quiet);

    let paths = paths(&args, &scene);
    let collected = RefCell::new(Collected::new(args.number));
    let mut first_path = 0;
    in_order(
        args.common.threads(),
        || {
            if collected.borrow().is_complete() {
                return Ok(None);
            }
            first_path += PATHS;
            Ok(Some(first_path - PATHS))
        },
        |first: u64| Traced::paths(&paths, first..first + PATHS),
        |traced: Traced| {
            let mut collected = collected.borrow_mut();
            let packed = collected.add(&traced, &paths)?;
            output.write(BlockMeta::default(), packed)?;
            progress.add(packed.len() as u64);
            check_hope(&args, collected.stored, collected.emitted)
        },
    )?;
    drop(progress);
    let Collected { stored, emitted, .. } = collected.into_inner();
    let report = StageReport::new(typed.program())
        .with("photons", Number::Count(stored))
        .with(measure::EMITTED_PATHS, Number::Count(emitted));
    output.finish(vec![report])?.commit()
}

/// The paths that are asked for.
fn paths<'a>(args: &Args, scene: &'a Scene) -> PhotonPaths<'a> {
    if args.caustics { PhotonPaths::of_caustics(scene, args.seed) } else { PhotonPaths::new(scene, args.seed) }
}

/// Gives a scene up that stores nothing.
fn check_hope(args: &Args, stored: u64, emitted: u64) -> anyhow::Result<()> {
    ensure!(
        stored > 0 || emitted < HOPELESS,
        "no photon{} met a diffuse surface in {emitted} paths: do the lights face the scene, and is anything diffuse (Kd)?",
        if args.caustics { " of a caustic" } else { "" },
    );
    Ok(())
}
