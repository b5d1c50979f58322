//! Traces photons from the lights of a scene and writes those stored at its surfaces.

use anyhow::{bail, ensure};
use clap::Parser;
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{BLOCK_RECORDS, BlockMeta, Number, Photon, RecordWriter, StageReport};
use pm_light::transport::{PathPhoton, PhotonPaths};
use pm_parallel::in_order;
use pm_programs::cli::{self, Common, OutputArgs, Progress, Typed};
use pm_programs::setting::{SceneArgs, header};
use std::cell::Cell;
use std::process::ExitCode;

/// Trace photons from the lights and store them at diffuse surfaces.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Photons to store: whole paths are traced until there are at least so many
    #[arg(short = 'n', long, value_name = "PHOTONS", default_value = "100000")]
    number: u64,
    /// Store caustics only: photons that came from a light by mirrors and glass alone; goes with `pm-queries --no-caustics`
    #[arg(long)]
    caustics: bool,
    /// Seed of the random numbers
    #[arg(long, default_value = "0")]
    seed: u64,
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    common: Common,
}

const EXAMPLES: &str = "\
Examples:
  pm-photons -o map.pmp
  pm-photons scenes/cornell-diffuse.obj -n 450000 -t 2 -o map.pmp
  pm-photons | pm-view --records=10";

/// Paths traced as one piece of work.
const PATHS: u64 = 4096;
/// Paths after which a scene that has stored nothing is given up.
const HOPELESS: u64 = 1 << 22;

fn main() -> ExitCode {
    cli::main("pm-photons", run)
}

/// Photons of consecutive paths, and after how many photons each path ends.
struct Traced {
    photons: Vec<PathPhoton>,
    path_ends: Vec<usize>,
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    let scene = args.scene.load(&args.common)?;
    let mut header = header(&scene);
    header.expected_records = Some(args.number);
    header.history.push(typed.step(Some(args.seed)));
    if args.caustics {
        header.set_meaning(meaning::PHOTONS, "caustics");
    }
    let mut output = RecordWriter::new(args.output.create()?, &header)?;
    let progress = Progress::new(header.expected_records, "photons", args.common.quiet);

    let paths = PhotonPaths::new(&scene, args.seed);
    let (emitted, stored) = (Cell::new(0u64), Cell::new(0u64));
    let mut first_path = 0;
    let mut packed: Vec<Photon> = Vec::with_capacity(BLOCK_RECORDS);
    in_order(
        args.common.threads(),
        || {
            if stored.get() >= args.number {
                return Ok(None);
            }
            first_path += PATHS;
            Ok(Some(first_path - PATHS))
        },
        |first: u64| {
            let mut traced = Traced { photons: vec![], path_ends: vec![] };
            for path in first..first + PATHS {
                paths.trace(path, |photon| {
                    if photon.caustic || !args.caustics {
                        traced.photons.push(photon);
                    }
                });
                traced.path_ends.push(traced.photons.len());
            }
            traced
        },
        |traced: Traced| {
            let mut from = 0;
            packed.clear();
            for end in traced.path_ends {
                // Work done ahead of the path that completes the number is dropped.
                if stored.get() >= args.number {
                    break;
                }
                for photon in &traced.photons[from..end] {
                    let id = stored.get();
                    let Some(photon) = paths.pack(id, photon) else {
                        bail!("the power of photon {id} is beyond what a photon can hold; is the light's Ke right?");
                    };
                    packed.push(photon);
                    stored.set(id + 1);
                }
                from = end;
                emitted.set(emitted.get() + 1);
            }
            output.write(BlockMeta::default(), &packed)?;
            progress.add(packed.len() as u64);
            ensure!(
                stored.get() > 0 || emitted.get() < HOPELESS,
                "no photon{} met a diffuse surface in {} paths: do the lights face the scene, and is anything diffuse (Kd)?",
                if args.caustics { " of a caustic" } else { "" },
                emitted.get()
            );
            Ok(())
        },
    )?;
    drop(progress);
    let report = StageReport::new(typed.program())
        .with("photons", Number::Count(stored.get()))
        .with(measure::EMITTED_PATHS, Number::Count(emitted.get()));
    output.finish(vec![report])?.commit()
}
