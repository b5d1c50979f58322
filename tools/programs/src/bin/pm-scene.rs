//! Writes scenes that are made by rule: OBJ, MTL and camera file.

use pm_light::make_scene::recipes;
use pm_programs::scene;
use std::process::ExitCode;

fn main() -> ExitCode {
    scene::program(&recipes()).main(scene::run)
}
