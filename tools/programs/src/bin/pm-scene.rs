//! Writes scenes that are made by rule: OBJ, MTL and camera file.

use pm_programs::{cli, scene};
use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main("pm-scene", scene::run)
}
