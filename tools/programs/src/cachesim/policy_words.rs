//! Words of the policies: what is said of each in the help, and how caches and lists of policies are read.

use clap::builder::{PossibleValue, TypedValueParser, ValueParser};
use clap::{Arg, Command};
use pm_caches::{CacheConfig, ChosenPolicy, Policy};
use pm_registry::Registry;
use std::ffi::OsStr;

/// The command with the policies of this registry.
pub(super) fn with_policies(command: Command, policies: &Registry<dyn Policy>) -> Command {
    let of_caches = policies.clone();
    let cache = move |text: &str| CacheConfig::parse(text, &of_caches);
    command
        .mut_arg("cache", |argument| argument.value_parser(cache))
        .mut_arg("policies", |argument| argument.value_parser(ValueParser::new(PolicyParser(policies.clone()))))
}

/// Understands a policy; the help lists all of a registry, with what is said of each.
#[derive(Clone)]
struct PolicyParser(Registry<dyn Policy>);

impl TypedValueParser for PolicyParser {
    type Value = ChosenPolicy;

    fn parse_ref(&self, command: &Command, argument: Option<&Arg>, value: &OsStr) -> Result<ChosenPolicy, clap::Error> {
        let policies = self.0.clone();
        (move |text: &str| ChosenPolicy::parse(text, &policies)).parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let of_caches = self.0.iter().filter(|entry| entry.keeps_lines());
        Some(Box::new(of_caches.map(|entry| PossibleValue::new(entry.word()).help(entry.help()))))
    }
}
