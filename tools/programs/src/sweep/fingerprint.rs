//! `pm-sweep fingerprint`: which sources the programs were built from.

use crate::cli::create_output;
use std::io::Write as _;
use std::path::Path;

/// Of all that makes streams and rows.
const PROGRAMS: &str = env!("PM_PROGRAMS");

/// Of that, and of all that makes tables and pages of rows.
const REPORTING: &str = env!("PM_REPORTING");

/// Both as variables of make's.
pub(super) fn variables() -> String {
    format!("PROGRAMS := {PROGRAMS}\nREPORTING := {REPORTING}\n")
}

pub(super) fn run() -> anyhow::Result<()> {
    let mut output = create_output(Path::new("-"))?;
    output.write_all(variables().as_bytes())?;
    output.commit()
}
