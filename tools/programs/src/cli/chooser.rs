//! Arguments for things that know no command line: an entry of a registry, and what may be said to it.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser as _, ValueParser};
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
use pm_registry::{Chosen, Domain, Parameter, ParameterError, Registered, Registry, Shared};

/// The word that leaves the choice to the program.
const AUTO: &str = "auto";

/// The arguments by which an entry is chosen, and asked: one for its word, and one for each parameter of any entry, whose
/// help says which entries take it. A parameter that is given to an entry which does not take it is refused.
pub struct Chooser<T: ?Sized + 'static> {
    registry: Registry<T>,
    /// The argument that takes the word.
    by: Arg,
    /// What is typed before the word: nothing, or the option's name.
    before: String,
}

impl<T: ?Sized> Clone for Chooser<T> {
    fn clone(&self) -> Self {
        Self { registry: self.registry.clone(), by: self.by.clone(), before: self.before.clone() }
    }
}

impl<T: Registered + Sync + ?Sized> Chooser<T> {
    /// An entry is chosen by an option; the first of the registry if it is not given. The argument has a name and a help.
    #[must_use]
    pub fn option(registry: &Registry<T>, argument: Arg) -> Self {
        let first = registry.iter().next().map_or("", |entry| entry.word());
        Self::new(registry, argument.default_value(first), None)
    }

    /// An entry is chosen by an option, or left to the program ([`read_or_choose`](Self::read_or_choose)): `auto`, of which
    /// this is said, if it is not given.
    #[must_use]
    pub fn automatic(registry: &Registry<T>, argument: Arg, help: &'static str) -> Self {
        let auto = PossibleValue::new(AUTO).help(help);
        Self::new(registry, argument.default_value(AUTO), Some(auto))
    }

    /// An entry is chosen by an argument in its place, which must be given.
    #[must_use]
    pub fn positional(registry: &Registry<T>, argument: Arg) -> Self {
        Self::new(registry, argument.required(true), None)
    }

    fn new(registry: &Registry<T>, by: Arg, auto: Option<PossibleValue>) -> Self {
        let entries =
            registry.iter().map(|entry| PossibleValue::new(entry.word()).aliases(entry.aliases()).help(entry.help()));
        let words: Vec<_> = auto.into_iter().chain(entries).collect();
        let all = registry.clone();
        let parser = PossibleValuesParser::new(words)
            .map(move |word| all.find(&word).map_or(word, |entry| entry.word().to_owned()));
        let before = by.get_long().map_or(String::new(), |long| format!("--{long} "));
        Self { registry: registry.clone(), by: by.value_parser(parser), before }
    }

    /// Adds the argument by which an entry is chosen.
    #[must_use]
    pub fn add_word(&self, command: Command) -> Command {
        command.arg(self.by.clone())
    }

    /// Adds what may be said to the entries.
    ///
    /// # Panics
    /// If the program has an option of one of these names: a mistake in the source.
    #[must_use]
    pub fn add_parameters(&self, mut command: Command) -> Command {
        for shared in self.registry.parameters() {
            let name = shared.parameter().name;
            let taken = command.get_arguments().any(|other| other.get_long() == Some(name) || other.get_id() == name);
            assert!(!taken, "--{name} is an option of the program");
            command = command.arg(argument(&shared));
        }
        command
    }

    /// The entry that was chosen, and what was said to it.
    ///
    /// # Errors
    /// If something was said to it that it does not take, or not what it needs.
    pub fn read(&self, matches: &ArgMatches) -> Result<Chosen<T>, clap::Error> {
        let word = matches.get_one::<String>(self.by.get_id().as_str()).map_or("", String::as_str);
        let entry = self.registry.find(word).map_err(|error| refused(error.to_string()))?;
        self.ask(entry, matches).map_err(|error| refused(self.told(&error)))
    }

    /// The entry that was chosen, and what was said to it; where that was left to the program, the first of these that takes what
    /// was said.
    ///
    /// # Errors
    /// If something was said to it that it does not take, or not what it needs; of several, what the last has against it.
    ///
    /// # Panics
    /// If there is none to choose from: a mistake in the source.
    pub fn read_or_choose(&self, matches: &ArgMatches, of: &[&'static T]) -> Result<Chosen<T>, clap::Error> {
        if !self.is_left(matches) {
            return self.read(matches);
        }
        let (last, others) = of.split_last().expect("something to choose from");
        let taken = others.iter().find_map(|entry| self.ask(entry, matches).ok());
        taken.map_or_else(|| self.ask(last, matches).map_err(|error| refused(self.told(&error))), Ok)
    }

    /// Was the choice left to the program?
    #[must_use]
    pub fn is_left(&self, matches: &ArgMatches) -> bool {
        matches.get_one::<String>(self.by.get_id().as_str()).is_some_and(|word| word == AUTO)
    }

    fn ask(&self, entry: &'static T, matches: &ArgMatches) -> Result<Chosen<T>, ParameterError> {
        let parameters = self.registry.parameters();
        let typed = |parameter: &Parameter| matches.value_source(parameter.name) == Some(ValueSource::CommandLine);
        let given = parameters.iter().map(Shared::parameter).filter(|parameter| typed(parameter)).map(|parameter| {
            let text = if parameter.is_flag() { None } else { matches.get_one::<String>(parameter.name) };
            (parameter.name, text.map_or("", String::as_str))
        });
        self.registry.ask(entry, given)
    }

    /// An error as it is told to one who types.
    fn told(&self, error: &ParameterError) -> String {
        match error {
            ParameterError::NotTaken { entry, name, takers } => {
                format!("--{name} is for {}{}, not for {entry}: leave --{name} out", self.before, takers.join(", "))
            }
            _ => error.to_string(),
        }
    }
}

fn refused(text: String) -> clap::Error {
    clap::Error::raw(ErrorKind::ArgumentConflict, format!("{text}\n"))
}

/// The argument of a parameter. Its text is kept: what it stands for is known by the entry.
fn argument(shared: &Shared) -> Arg {
    let parameter = shared.parameter();
    let argument =
        Arg::new(parameter.name).long(parameter.name).hide_short_help(shared.is_hidden()).help(shared.help());
    let argument = match shared.details() {
        details if details.is_empty() => argument,
        details => argument.long_help(format!("{}\n\n{details}", shared.help())),
    };
    if parameter.is_flag() {
        return argument.action(ArgAction::SetTrue);
    }
    let parser = match parameter.domain {
        Domain::Word(words) => {
            let words = words().into_iter().map(|it| PossibleValue::new(it.word).aliases(it.aliases).help(it.help));
            PossibleValuesParser::new(words).into()
        }
        domain => ValueParser::from(move |text: &str| domain.check(text).map(|()| text.to_owned())),
    };
    argument.value_name(parameter.value_name).value_parser(parser).default_value(shared.default())
}

#[cfg(test)]
mod tests;
