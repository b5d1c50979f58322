//! Turns tables of experiments into rules for make, and what their points gave into results.

use std::process::ExitCode;

fn main() -> ExitCode {
    pm_programs::cli::main("pm-sweep", pm_programs::sweep::run)
}
