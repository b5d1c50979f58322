//! Looks into streams: what they are about, where they came from, whether they are whole, what their records say.

use pm_exchange::traces::exports;
use pm_programs::view;
use std::process::ExitCode;

fn main() -> ExitCode {
    view::program(&exports()).main(view::run)
}
