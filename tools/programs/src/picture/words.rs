//! Options as they were typed, to be handed on to another program.

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command};

/// The options of `A` that were typed, each as one word so that no value is taken for an option; what stands in its place,
/// such as the name of a file, comes last.
pub(crate) fn of<A: Args>(matches: &ArgMatches) -> Vec<String> {
    let command = A::augment_args(Command::new("options"));
    let typed = |argument: &&Arg| matches.value_source(argument.get_id().as_str()) == Some(ValueSource::CommandLine);
    let (options, places): (Vec<_>, Vec<_>) =
        command.get_arguments().filter(typed).partition(|argument| argument.get_long().is_some());
    let values = |argument: &Arg| {
        let raw = matches.get_raw(argument.get_id().as_str()).into_iter().flatten();
        raw.map(|value| value.to_string_lossy().into_owned()).collect::<Vec<_>>()
    };
    let mut words = vec![];
    for option in options {
        let name = option.get_long().unwrap_or_default();
        if option.get_action().takes_values() {
            words.extend(values(option).iter().map(|value| format!("--{name}={value}")));
        } else {
            words.push(format!("--{name}"));
        }
    }
    for place in places {
        // A file whose name begins with a dash is still a file.
        let named = |value: String| if value.starts_with('-') { format!("./{value}") } else { value };
        words.extend(values(place).into_iter().map(named));
    }
    words
}
