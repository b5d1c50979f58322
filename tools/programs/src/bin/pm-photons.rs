//! Traces photons from the lights of a scene and writes those stored at its surfaces.

use pm_programs::{cli, photons};
use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main("pm-photons", photons::run)
}
