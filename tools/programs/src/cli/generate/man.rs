//! Manual pages: synopsis with values, examples and exit codes under their names.

use super::options::{names, with_value};
use clap::{Arg, Command};
use clap_mangen::Man;
use clap_mangen::roff::{Inline, Roff, bold, italic, roman};
use std::io::{Result, Write};

/// Writes the manual page of a program.
pub(super) fn page(command: &Command, output: &mut dyn Write) -> Result<()> {
    let man = Man::new(command.clone());
    man.render_title(output)?;
    man.render_name_section(output)?;
    let mut synopsis = Roff::new();
    synopsis.control("SH", ["SYNOPSIS"]);
    synopsis.text(asked(command));
    synopsis.to_writer(output)?;
    man.render_description_section(output)?;
    man.render_options_section(output)?;
    if command.has_subcommands() {
        man.render_subcommands_section(output)?;
    }
    let text = command.get_after_long_help().map_or(String::new(), ToString::to_string);
    sections(&text).to_writer(output)?;
    man.render_version_section(output)
}

/// The program, and each argument with what it takes.
fn asked(command: &Command) -> Vec<Inline> {
    let mut line = vec![bold(command.get_name())];
    let (positionals, options): (Vec<&Arg>, Vec<&Arg>) = command
        .get_arguments()
        .filter(|argument| !argument.is_hide_set())
        .partition(|argument| argument.is_positional());
    for argument in options.into_iter().chain(positionals) {
        let (before, after) = if argument.is_required_set() { (" ", "") } else { (" [", "]") };
        line.push(roman(before));
        let names = names(argument);
        if !names.is_empty() {
            line.push(bold(names.join("|")));
        }
        if let Some(value) = with_value(argument) {
            line.extend((!names.is_empty()).then(|| roman(" ")));
            line.push(italic(value));
        }
        line.push(roman(after));
    }
    if command.has_subcommands() {
        line.push(roman(" "));
        line.push(italic("COMMAND"));
    }
    line
}

/// Paragraphs that begin with a title and a colon, each as a section whose lines stay as they are.
fn sections(text: &str) -> Roff {
    let mut roff = Roff::new();
    for paragraph in text.split("\n\n") {
        let (title, lines) = paragraph.split_once(":\n").unwrap_or(("Notes", paragraph));
        roff.control("SH", [title.to_uppercase().as_str()]);
        roff.control("nf", []);
        for line in lines.lines() {
            roff.text([roman(line.strip_prefix("  ").unwrap_or(line))]);
        }
        roff.control("fi", []);
    }
    roff
}
