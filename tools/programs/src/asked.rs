//! Options as they were typed, to be handed on to another program.

use crate::setting::{CameraArgs, SceneArgs};
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};

/// What was asked: options, and those of the scene and the camera as they go to other programs.
pub struct Asked<A> {
    pub(crate) args: A,
    pub(crate) scene: Vec<String>,
    pub(crate) camera: Vec<String>,
}

impl<A: FromArgMatches> Asked<A> {
    /// What these matches say.
    pub(crate) fn read(matches: &ArgMatches) -> Result<Self, clap::Error> {
        Ok(Self {
            args: A::from_arg_matches(matches)?,
            scene: of::<SceneArgs>(matches),
            camera: of::<CameraArgs>(matches),
        })
    }
}

/// The options of `A` that were typed, each as one word so that no value is taken for an option; what stands in its place,
/// such as the name of a file, comes last.
fn of<A: Args>(matches: &ArgMatches) -> Vec<String> {
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
