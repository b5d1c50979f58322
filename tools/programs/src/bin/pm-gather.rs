//! Answers gather queries from a photon map and writes the memory reads that this takes.

use std::process::ExitCode;

fn main() -> ExitCode {
    pm_programs::gather::main(&pm_maps::structures())
}
