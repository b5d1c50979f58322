//! What is made from the definition of a program's arguments: a manual page, completions, and its page of options.

mod man;
mod options;

use super::{Outcome, create_output};
use clap::{Arg, Command};
use std::io::Write as _;
use std::path::Path;
use std::str::FromStr as _;

/// What may be made, as `--generate` has it.
const MADE: &str = "man, bash, zsh, fish, options";

/// The argument that asks for it, of every program.
pub(super) fn generate_argument() -> Arg {
    let help = "Print what is made of these definitions, alone: the manual page, completions for a shell, or a page of the options";
    let argument = Arg::new("generate").long("generate").value_name("man|bash|zsh|fish|options").exclusive(true);
    argument.hide_short_help(true).help(help)
}

/// Prints a manual page, completions for a shell, or the options as a page.
pub(super) fn generate(mut command: Command, program: &str, what: &str) -> Outcome {
    command.build();
    let mut text = Vec::new();
    let done = match what {
        "man" => man::page(&command, &mut text),
        "options" => {
            text.extend(options::page(&command).into_bytes());
            Ok(())
        }
        "bash" | "zsh" | "fish" => {
            let shell = clap_complete::Shell::from_str(what).expect("one of the names above");
            clap_complete::generate(shell, &mut command, program, &mut text);
            Ok(())
        }
        _ => return Outcome::asked_wrongly(format!("--generate {what}: one of {MADE} was expected")),
    };
    let done = done.map_err(Into::into).and_then(|()| {
        let mut output = create_output(Path::new("-"))?;
        output.write_all(&text)?;
        output.commit()
    });
    Outcome::of(done)
}
