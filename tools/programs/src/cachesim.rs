//! `pm-cachesim`: simulates caches over a trace and prints what each would fetch.

mod args;
mod cache_result;
mod columns;
mod curve_point;
mod found;
mod miss_file;
mod part_counts;
mod policy_words;
mod questions;
mod replay;
mod results;
mod simulate;
mod sizes;
mod traffic;
mod windowed;

pub use args::Args;

use crate::cli::{Program, Typed, usage};
use crate::foreign_args::ForeignArgs;
use clap::{CommandFactory as _, FromArgMatches as _};
use pm_caches::Policy;
use pm_exchange::traces::TraceImport;
use pm_registry::Registry;
use questions::Questions;
use results::Results;
use std::path::Path;

/// What it knows by words.
pub struct Registries {
    /// Policies of caches.
    pub policies: Registry<dyn Policy>,
    /// Formats of traces.
    pub imports: Registry<dyn TraceImport>,
}

impl Default for Registries {
    /// All that the libraries have.
    fn default() -> Self {
        Self { policies: pm_caches::policies(), imports: pm_exchange::traces::imports() }
    }
}

/// The program.
#[must_use]
pub fn program(registries: &Registries) -> Program<Args> {
    let command = policy_words::with_policies(Args::command(), &registries.policies);
    Program::new("pm-cachesim", ForeignArgs::of_formats(command, &registries.imports), Args::from_arg_matches)
}

/// What it prints: the table of what was found; none, if standard output is taken by a trace of misses.
///
/// # Errors
/// If it was asked wrongly, or a trace cannot be read or simulated.
pub fn run(args: &Args, typed: &Typed, registries: &Registries) -> anyhow::Result<Option<Vec<u8>>> {
    let questions = Questions::new(args)?;
    if args.traces.iter().filter(|trace| *trace == Path::new("-")).count() > 1 {
        return Err(usage("standard input (`-`) can be read only once"));
    }
    let mut results = Results::default();
    if args.counts {
        return part_counts::count(args, &registries.imports, &questions).map(Some);
    }
    if args.add {
        part_counts::add_up(args, &questions, &mut results)?;
    } else if let Some(file) = &args.misses {
        miss_file::write(args, typed, registries, &questions, file, &mut results)?;
        if file == Path::new("-") && args.output() == Path::new("-") {
            return Ok(None);
        }
    } else {
        simulate::simulate_all(args, &registries.imports, &questions, &mut results)?;
    }
    // The table is written when every trace was read to its end: a broken pipe yields none.
    let mut table = vec![];
    results.table(args).write(args.format, &mut table)?;
    Ok(Some(table))
}
