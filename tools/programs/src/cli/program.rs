//! A program from its command line to its exit code, in a process of its own or in a test.

use super::outcome::Outcome;
use super::{EXIT_CODES, LONG_VERSION, PROGRAM, Typed, VERSION, claims, create_output, signals, typed};
use clap::{ArgMatches, Command, CommandFactory, FromArgMatches};
use std::ffi::OsString;
use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;
use std::str::FromStr as _;

/// How what was typed is understood.
type Read<A> = dyn FnOnce(&ArgMatches) -> Result<A, clap::Error>;

/// A program that is asked with arguments `A`: what it is called, what it may be asked, and how that is understood.
pub struct Program<A> {
    name: &'static str,
    command: Command,
    read: Box<Read<A>>,
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
        let command = command
            .name(name)
            .version(VERSION)
            .long_version(LONG_VERSION)
            .max_term_width(100)
            .after_long_help(format!("{examples}\n\n{EXIT_CODES}"));
        Self { name, command, read: Box::new(read) }
    }

    /// Runs it as a process: with the arguments of the process, and its outcome told to whoever started it.
    pub fn main(self, run: impl FnOnce(A, &Typed) -> anyhow::Result<()>) -> ExitCode {
        let _ = PROGRAM.set(self.name.to_owned());
        signals::watch();
        self.run(std::env::args_os().skip(1), run).tell()
    }

    /// Runs it with these arguments, and tells nobody.
    pub fn run<T: Into<OsString>>(
        self,
        arguments: impl IntoIterator<Item = T>,
        run: impl FnOnce(A, &Typed) -> anyhow::Result<()>,
    ) -> Outcome {
        let Self { name, command, read } = self;
        claims::clear();
        let raw: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
        if let [flag, what] = &raw[..]
            && flag == "--generate"
        {
            return generate(command, name, &what.to_string_lossy());
        }
        let typed = Typed { program: name, arguments: typed::lasting_arguments(&command, &raw) };
        let matches = command.try_get_matches_from(std::iter::once(OsString::from(name)).chain(raw));
        match matches.and_then(|matches| read(&matches)) {
            Ok(arguments) => Outcome::of(run(arguments, &typed)),
            Err(error) => Outcome::answered(error),
        }
    }
}

/// Prints a manual page or shell completions made from the arguments' own definition.
fn generate(mut command: Command, program: &str, what: &str) -> Outcome {
    let mut text = Vec::new();
    let done = match what {
        "man" => clap_mangen::Man::new(command).render(&mut text),
        "bash" | "zsh" | "fish" => {
            let shell = clap_complete::Shell::from_str(what).expect("one of the names above");
            clap_complete::generate(shell, &mut command, program, &mut text);
            Ok(())
        }
        _ => return Outcome::asked_wrongly(format!("--generate {what}: one of man, bash, zsh, fish was expected")),
    };
    let done = done.map_err(Into::into).and_then(|()| {
        let mut output = create_output(Path::new("-"))?;
        output.write_all(&text)?;
        output.commit()
    });
    Outcome::of(done)
}
