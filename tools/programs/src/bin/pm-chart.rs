//! Draws charts of tables, and puts charts, tables, pictures and text on a page.

use pm_programs::{chart, cli};
use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main("pm-chart", chart::run)
}
