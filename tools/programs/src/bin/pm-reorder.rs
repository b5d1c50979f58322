//! Puts a stream of gather queries into another order, changing nothing else.

use std::process::ExitCode;

fn main() -> ExitCode {
    pm_programs::reorder::main(&pm_orders::orders())
}
