//! What an entry of a registry was asked: a value for each of its parameters.

use crate::{Choice, Domain, Parameter, ParameterError, Value};

/// The parameters of an entry with their values: those that were given, and defaults.
///
/// Its methods ask for a parameter by name and panic if the entry has declared none of that name and domain: that is a
/// mistake in the source.
#[derive(Clone, Debug)]
pub struct Values(Vec<Held>);

#[derive(Clone, Debug)]
struct Held {
    parameter: &'static Parameter,
    value: Option<Value>,
    is_given: bool,
}

impl Values {
    /// The values of these parameters of `entry`, of which some were given: name and text of each.
    ///
    /// # Errors
    /// If one is given that is not among them, twice, or with a text that is no value of it; or if one that is needed is
    /// not given.
    pub fn new<'a>(
        entry: &'static str,
        parameters: impl IntoIterator<Item = &'static Parameter>,
        given: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self, ParameterError> {
        let default = |parameter: &Parameter| match (parameter.domain, parameter.default) {
            (Domain::Flag, _) => Some(Value::Flag(false)),
            (_, text) => text.map(|text| parameter.parse(text).expect("a default is a value")),
        };
        let held = |parameter| Held { parameter, value: default(parameter), is_given: false };
        let mut values = Self(parameters.into_iter().map(held).collect());
        for (name, text) in given {
            let Some(held) = values.0.iter_mut().find(|held| held.parameter.name == name) else {
                let takers = vec![];
                return Err(ParameterError::NotTaken { entry, name: name.to_owned(), takers });
            };
            if std::mem::replace(&mut held.is_given, true) {
                return Err(ParameterError::Twice(held.parameter.name));
            }
            held.value = Some(held.parameter.parse(text)?);
        }
        match values.0.iter().find(|held| held.parameter.is_needed && !held.is_given) {
            Some(Held { parameter, .. }) => {
                Err(ParameterError::Needed { entry, name: parameter.name, value_name: parameter.value_name })
            }
            None => Ok(values),
        }
    }

    fn held(&self, name: &str) -> &Held {
        let found = self.0.iter().find(|held| held.parameter.name == name);
        found.unwrap_or_else(|| panic!("the parameter {name} is not declared"))
    }

    /// Was a value given, where there may be a default?
    #[must_use]
    pub fn is_given(&self, name: &str) -> bool {
        self.held(name).is_given
    }

    /// The value of a parameter of any domain, if it has one.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.held(name).value.as_ref()
    }

    /// Was this flag given?
    #[must_use]
    pub fn flag(&self, name: &str) -> bool {
        matches!(self.get(name), Some(Value::Flag(true)))
    }

    /// A whole number, if one was given or is the default.
    #[must_use]
    pub fn count_if_any<T: TryFrom<u64>>(&self, name: &str) -> Option<T> {
        self.get(name).map(|value| match value {
            Value::Count(count) => T::try_from(*count).unwrap_or_else(|_| unfit(name)),
            _ => unfit(name),
        })
    }

    /// A whole number that has a default or is needed.
    #[must_use]
    pub fn count<T: TryFrom<u64>>(&self, name: &str) -> T {
        self.count_if_any(name).unwrap_or_else(|| unfit(name))
    }

    /// A share that has a default or is needed.
    #[must_use]
    pub fn share(&self, name: &str) -> f64 {
        match self.get(name) {
            Some(Value::Share(share)) => *share,
            _ => unfit(name),
        }
    }

    /// A length in scene units, if one was given or is the default.
    #[must_use]
    pub fn length_if_any(&self, name: &str) -> Option<f32> {
        self.get(name).map(|value| match value {
            Value::Length(length) => *length,
            _ => unfit(name),
        })
    }

    /// One of a choice's values, whose words the parameter takes and which has a default or is needed.
    #[must_use]
    pub fn choice<T: Choice>(&self, name: &str) -> T {
        match self.get(name) {
            Some(Value::Word(word)) => T::of_word(word).unwrap_or_else(|| unfit(name)),
            _ => unfit(name),
        }
    }

    /// The file that was given, by whichever parameter takes one.
    #[must_use]
    pub fn file(&self) -> Option<&str> {
        self.0.iter().find_map(|held| match &held.value {
            Some(Value::File(file)) => Some(file.as_str()),
            _ => None,
        })
    }

    /// The seed, if the entry draws random numbers.
    #[must_use]
    pub fn seed(&self) -> Option<u64> {
        let seed = self.0.iter().find(|held| matches!(held.parameter.domain, Domain::Seed))?;
        self.count_if_any(seed.parameter.name)
    }
}

fn unfit(name: &str) -> ! {
    panic!("the parameter {name} is of another domain, or has no value")
}
