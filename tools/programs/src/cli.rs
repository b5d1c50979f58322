//! How every pm program behaves: arguments, input and output, messages, exit codes.

mod advice;
mod choice;
mod chooser;
pub(crate) mod claims;
mod entry;
mod error;
mod generate;
mod input;
mod memory;
mod outcome;
mod output;
mod parts;
mod picture;
mod program;
mod progress;
mod signals;
mod typed;
mod usage;

pub use choice::{ChoiceParser, choice};
pub use chooser::Chooser;
pub use entry::{EntryParser, entry};
pub use input::{Input, Whole, named, open_bytes, open_input, read_whole};
pub use memory::room_for;
pub use outcome::Outcome;
pub use output::{Output, OutputArgs, create_output};
pub use parts::{refuse_part, refuse_parts};
pub use picture::{
    PART, QUERIES, check_part_of_picture, describe_picture, picture_format, picture_says, read_framed, read_preview,
    write_picture,
};
pub use program::Program;
pub use progress::Progress;
pub use usage::{Refusal, UsageError, refusal, usage};

use clap::{Command, CommandFactory, FromArgMatches};
use pm_formats::Step;
use pm_report::printable;
use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;
use std::sync::OnceLock;

/// Version with commit, as it goes into streams.
pub const VERSION: &str = env!("PM_VERSION");

/// The name and version that pictures say they were made by.
#[must_use]
pub fn software() -> String {
    format!("pm {VERSION}")
}

/// What `--version` prints: the version, and the format of the streams.
pub const LONG_VERSION: &str = concat!(env!("PM_VERSION"), "\nstream format version 2");

/// The paragraph on exit codes that ends every help.
pub const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  failed: the system refused, or what was asked cannot be done
  2  asked wrongly: see the message
  3  an input stream is incomplete or damaged";

static PROGRAM: OnceLock<String> = OnceLock::new();

/// Quiet: what every program takes.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct Voice {
    /// No progress and no remarks on standard error
    #[arg(short, long)]
    pub quiet: bool,
}

impl Voice {
    /// Says something on standard error, unless quiet.
    pub fn remark(&self, text: impl std::fmt::Display) {
        if !self.quiet {
            say(text);
        }
    }
}

/// Threads and quiet: what the programs take whose work can be shared out.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct Common {
    /// Threads to work with; the output does not depend on it
    #[arg(short, long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: u16,
    /// No progress and no remarks on standard error
    #[arg(short, long)]
    pub quiet: bool,
}

impl Common {
    /// Number of threads.
    #[must_use]
    pub fn threads(&self) -> usize {
        usize::from(self.threads)
    }

    /// Says something on standard error, unless quiet.
    pub fn remark(&self, text: impl std::fmt::Display) {
        Voice { quiet: self.quiet }.remark(text);
    }
}

/// What was typed, for the history of the streams written.
pub struct Typed {
    program: &'static str,
    arguments: Vec<String>,
}

impl Typed {
    /// The history entry of this run, which draws random numbers from `seed` if it does.
    #[must_use]
    pub fn step(&self, seed: Option<u64>) -> Step {
        Step {
            program: self.program.to_owned(),
            version: VERSION.to_owned(),
            arguments: self.arguments.clone(),
            seed,
            input: None,
            inputs: vec![],
        }
    }

    /// The history entry of this run, which reads the stream from `input`.
    #[must_use]
    pub fn step_from(&self, input: &Path, seed: Option<u64>) -> Step {
        let named = (input != Path::new("-")).then(|| input.display().to_string());
        Step { input: named, ..self.step(seed) }
    }

    /// Name of the program.
    #[must_use]
    pub const fn program(&self) -> &'static str {
        self.program
    }
}

/// Runs a program: parses its arguments, and turns its outcome into a message and an exit code.
pub fn main<A: CommandFactory + FromArgMatches + 'static>(
    program: &'static str,
    run: impl FnOnce(A, &Typed) -> anyhow::Result<()>,
) -> ExitCode {
    Program::derived(program).main(run)
}

/// The same with arguments that are not all known to the compiler, such as words that a registry holds.
pub fn main_of<A: FromArgMatches + 'static>(
    program: &'static str,
    command: Command,
    run: impl FnOnce(A, &Typed) -> anyhow::Result<()>,
) -> ExitCode {
    Program::new(program, command, |matches| A::from_arg_matches(matches)).main(run)
}

/// A line on standard error that says who speaks.
pub fn say(text: impl std::fmt::Display) {
    let program = PROGRAM.get().map_or("pm", String::as_str);
    // Nobody is left to tell if standard error is closed.
    let _ = writeln!(std::io::stderr(), "{program}: {}", printable(&text.to_string()));
}
