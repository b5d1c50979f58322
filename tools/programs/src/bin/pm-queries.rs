//! Casts the rays of a picture and writes where photons are to be gathered.

use pm_orders::generative_orders;
use pm_programs::queries;
use std::process::ExitCode;

fn main() -> ExitCode {
    queries::program(&generative_orders()).main(queries::run)
}
