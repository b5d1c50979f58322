//! The program pm-sweep: experiments as tables, for make to run.

mod derive;
mod fingerprint;
mod hold;
mod join;
mod place;
mod row;
mod rules;
mod stack;
mod tables;
mod until;

use crate::cli::Typed;
use clap::{Parser, Subcommand};

/// Turn tables of experiments into rules for make, and what their points gave into results.
///
/// A table names the points of a sweep: each is a target of its own, out/SWEEP/POINT.csv, and out/SWEEP.csv has the rows of
/// all. The Makefile calls this program; `scripts/README.md` says how a table is written.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  pm-sweep rules --words scripts/words.csv my.csv
  pm-sweep join --words scripts/words.csv my.csv -o out/my.csv";

#[derive(Subcommand)]
enum Command {
    /// Write rules for make: a target for each point of the tables, and for the streams that points have in common
    Rules(rules::Args),
    /// Believe what a point printed: whole rows become its file
    Row(row::Args),
    /// Join the rows of a table's points, the labels of each in front
    Join(join::Args),
    /// Put tables with the same columns below one another
    Stack(stack::Args),
    /// Add windows of a stream until fetches per query are known as well as asked
    Until(Box<until::Args>),
    /// Make a table of results, or judge them: see `pm-sweep derive --list`
    Derive(derive::Args),
    /// Write a scene in another unit and at another place
    Place(place::Args),
    /// Print which sources the programs were built from, as variables for make
    Fingerprint,
    /// Take a folder for a process until its end, or say who has it
    Hold(hold::Args),
}

/// Runs the program.
///
/// # Errors
/// What the command reports.
pub fn run(args: Args, _: &Typed) -> anyhow::Result<()> {
    match args.command {
        Command::Rules(args) => rules::run(&args),
        Command::Row(args) => row::run(&args),
        Command::Join(args) => join::run(&args),
        Command::Stack(args) => stack::run(&args),
        Command::Until(args) => until::run(&args),
        Command::Derive(args) => derive::run(&args),
        Command::Place(args) => place::run(&args),
        Command::Fingerprint => fingerprint::run(),
        Command::Hold(args) => hold::run(&args),
    }
}
