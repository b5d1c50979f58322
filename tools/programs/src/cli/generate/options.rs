//! Pages of options: what `--help` says, as tables.

use clap::{Arg, ArgAction, Command};
use std::fmt::Write as _;

/// The page of a program.
pub(super) fn page(command: &Command) -> String {
    let name = command.get_name();
    let mut page = format!(
        "# {name}\n\n{}\n\nThis page is made by `{name} --generate options`; `{name} --help` says the same.\n",
        paragraphs(&text(command.get_long_about().or_else(|| command.get_about())))
    );
    tables(command, &mut page);
    for command in command.get_subcommands().filter(|command| command.get_name() != "help") {
        let about = text(command.get_long_about().or_else(|| command.get_about()));
        let _ = write!(page, "\n## {name} {}\n\n{}\n", command.get_name(), paragraphs(&about));
        tables(command, &mut page);
    }
    let after = command.get_after_long_help().map_or(String::new(), ToString::to_string);
    for paragraph in after.split("\n\n") {
        let (title, lines) = paragraph.split_once(":\n").unwrap_or(("Notes", paragraph));
        let _ = write!(page, "\n## {title}\n\n");
        for line in lines.lines() {
            let _ = writeln!(page, "    {}", line.strip_prefix("  ").unwrap_or(line));
        }
    }
    page
}

/// Arguments that have a place, then options.
fn tables(command: &Command, page: &mut String) {
    let shown = |argument: &&Arg| !argument.is_hide_set() && !["help", "version"].contains(&argument.get_id().as_str());
    let (places, options): (Vec<&Arg>, Vec<&Arg>) =
        command.get_arguments().filter(shown).partition(|argument| argument.is_positional());
    for (heading, arguments) in [("argument", places), ("option", options)] {
        if arguments.is_empty() {
            continue;
        }
        let _ = write!(page, "\n| {heading} | is |\n| --- | --- |\n");
        for argument in arguments {
            let _ = writeln!(page, "| {} | {} |", cell(&called(argument)), said(argument));
        }
    }
}

/// The names of an option.
pub(super) fn names(argument: &Arg) -> Vec<String> {
    let short = argument.get_short().map(|short| format!("-{short}"));
    short.into_iter().chain(argument.get_long().map(|long| format!("--{long}"))).collect()
}

/// The name of what an argument takes, if it takes something.
pub(super) fn with_value(argument: &Arg) -> Option<String> {
    let takes = argument.is_positional() || argument.get_action().takes_values();
    let names = argument.get_value_names().map(|names| names.iter().map(ToString::to_string).collect::<Vec<_>>());
    takes.then(|| names.map_or_else(|| argument.get_id().to_string().to_uppercase(), |names| names.join(" ")))
}

fn called(argument: &Arg) -> String {
    let names = names(argument).into_iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    match with_value(argument) {
        Some(value) if names.is_empty() => format!("`{value}`"),
        Some(value) => format!("{names} `{value}`"),
        None => names,
    }
}

/// Everything that the help says of an argument.
fn said(argument: &Arg) -> String {
    let mut said = cell(&paragraphs(&text(argument.get_long_help().or_else(|| argument.get_help()))));
    let words: Vec<_> = argument.get_possible_values().into_iter().filter(|word| !word.is_hide_set()).collect();
    if !words.is_empty() && argument.get_action().takes_values() {
        for word in words {
            let help = word.get_help().map_or(String::new(), |help| format!(": {help}"));
            let _ = write!(said, "<br>`{}`{}", word.get_name(), cell(&help));
        }
    }
    let defaults: Vec<_> = argument.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    if !defaults.is_empty() && argument.get_action().takes_values() {
        let _ = write!(said, "<br>Without it: `{}`", defaults.join(","));
    }
    if matches!(argument.get_action(), ArgAction::Append)
        && !said.contains("may be repeated")
        && argument.get_value_delimiter().is_none()
    {
        said.push_str("<br>May be repeated");
    }
    said
}

fn text(styled: Option<&clap::builder::StyledStr>) -> String {
    styled.map_or(String::new(), ToString::to_string)
}

/// Paragraphs as they stand, their lines joined.
fn paragraphs(text: &str) -> String {
    text.split("\n\n")
        .map(|paragraph| paragraph.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect::<Vec<_>>()
        .join("\n\n")
}

/// A text as one cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace("\n\n", "<br>").replace('<', "&lt;").replace("&lt;br>", "<br>")
}
