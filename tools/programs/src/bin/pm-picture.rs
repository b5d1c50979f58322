//! Makes a picture with the other programs, and prints the pipes by which it does.

use pm_programs::picture;
use std::process::ExitCode;

fn main() -> ExitCode {
    picture::program().main(picture::run)
}
