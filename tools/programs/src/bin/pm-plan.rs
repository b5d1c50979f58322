//! Says how little a picture needs: the cheapest recipe of an error that is wanted, with what it will take.

use pm_programs::plan;
use std::process::ExitCode;

fn main() -> ExitCode {
    plan::program().main(plan::run)
}
