//! Casts the rays of a picture and writes where photons are to be gathered.

use pm_programs::{cli, queries};
use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main("pm-queries", queries::run)
}
