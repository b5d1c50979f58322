//! A program from its command line to its exit code, in a process of its own or in a test.

use super::generate::{generate, generate_argument};
use super::memory::room_to_begin;
use super::outcome::Outcome;
use super::{EXIT_CODES, LONG_VERSION, PROGRAM, Typed, VERSION, claims, signals, typed};
use clap::{Arg, ArgMatches, Command, CommandFactory, FromArgMatches};
use std::ffi::OsString;
use std::process::ExitCode;

/// How what was typed is understood.
type Read<A> = dyn FnOnce(&ArgMatches) -> Result<A, clap::Error>;

/// A program that is asked with arguments `A`: what it is called, what it may be asked, and how that is understood.
pub struct Program<A> {
    name: &'static str,
    command: Command,
    read: Box<Read<A>>,
    advise: fn(&clap::Error) -> Option<String>,
}

impl<A: CommandFactory + FromArgMatches + 'static> Program<A> {
    /// A program whose arguments are declared by their type.
    #[must_use]
    pub fn derived(name: &'static str) -> Self {
        Self::new(name, A::command(), |matches| A::from_arg_matches(matches))
    }
}

impl<A> Program<A> {
    /// A program whose arguments are put together when it runs, such as from a registry.
    #[must_use]
    pub fn new(
        name: &'static str,
        command: Command,
        read: impl FnOnce(&ArgMatches) -> Result<A, clap::Error> + 'static,
    ) -> Self {
        let examples = command.get_after_help().map_or(String::new(), |examples| examples.to_string());
        // A program of commands is asked for one of them.
        let generate = (!command.has_subcommands()).then(generate_argument);
        let command = command
            .name(name)
            .version(VERSION)
            .long_version(LONG_VERSION)
            .max_term_width(100)
            .args(generate)
            .mut_args(with_negative_numbers)
            .after_long_help(format!("{examples}\n\n{EXIT_CODES}"));
        Self { name, command, read: Box::new(read), advise: |_| None }
    }

    /// What is said besides where arguments are not understood.
    #[must_use]
    pub fn advising(self, advise: fn(&clap::Error) -> Option<String>) -> Self {
        Self { advise, ..self }
    }

    /// The same for a program that may find that nothing will do (exit code 4).
    #[must_use]
    pub fn that_may_refuse(self) -> Self {
        let help = self.command.get_after_long_help().map_or(String::new(), ToString::to_string);
        let command = self.command.after_long_help(format!("{help}\n  4  refused: nothing that may be chosen will do"));
        Self { command, ..self }
    }

    /// Runs it as a process: with the arguments of the process, and its outcome told to whoever started it.
    pub fn main(self, run: impl FnOnce(A, &Typed) -> anyhow::Result<()>) -> ExitCode {
        let _ = PROGRAM.set(self.name.to_owned());
        if let Err(error) = room_to_begin() {
            return Outcome::of(Err(error)).tell();
        }
        signals::watch();
        self.run(std::env::args_os().skip(1), run).tell()
    }

    /// Runs it with these arguments, and tells nobody.
    pub fn run<T: Into<OsString>>(
        self,
        arguments: impl IntoIterator<Item = T>,
        run: impl FnOnce(A, &Typed) -> anyhow::Result<()>,
    ) -> Outcome {
        let Self { name, command, read, advise } = self;
        claims::clear();
        let raw: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
        if let Some(what) = to_generate(&raw) {
            return generate(command, name, &what);
        }
        let typed = Typed { program: name, arguments: typed::lasting_arguments(&command, &raw) };
        let matches = command.try_get_matches_from(std::iter::once(OsString::from(name)).chain(raw));
        match matches.and_then(|matches| read(&matches)) {
            Ok(arguments) => Outcome::of(run(arguments, &typed)),
            Err(error) => {
                let advice = advise(&error);
                Outcome::answered(error).with(advice)
            }
        }
    }
}

/// What is to be generated, if nothing else is asked: whatever arguments the program needs, they are not needed for that.
fn to_generate(raw: &[OsString]) -> Option<String> {
    match raw {
        [flag, what] if flag == "--generate" => Some(what.to_string_lossy().into_owned()),
        [one] => one.to_string_lossy().strip_prefix("--generate=").map(str::to_owned),
        _ => None,
    }
}

/// What looks like a negative number behind an option is its value, to be taken or refused as such.
fn with_negative_numbers(argument: Arg) -> Arg {
    let takes_value = argument.get_action().takes_values() && !argument.is_positional();
    if takes_value { argument.allow_negative_numbers(true) } else { argument }
}
