//! What a thing needs to be chosen by its word.

use crate::Parameter;

/// A thing that can be chosen by its word.
pub trait Registered {
    /// The word: lower case, hyphens.
    fn word(&self) -> &'static str;

    /// What is said of it: one line, without a full stop.
    fn help(&self) -> &'static str;

    /// Words that are understood as well.
    fn aliases(&self) -> &'static [&'static str] {
        &[]
    }

    /// What else may be said to it, besides what may be said to all of its registry.
    fn parameters(&self) -> &'static [Parameter] {
        &[]
    }
}

/// Makes a `struct` without fields that is chosen by a word: the documentation is its help, the parameters follow `with`.
///
/// ```
/// pm_registry::registered! {
///     /// Fells trees
///     pub struct Axe = "axe";
/// }
/// use pm_registry::Registered as _;
/// assert_eq!((Axe.word(), Axe.help()), ("axe", "Fells trees"));
/// ```
#[macro_export]
macro_rules! registered {
    (#[doc = $help:literal] $visibility:vis struct $Name:ident = $word:literal $(| $alias:literal)*
        $(with [$($parameter:expr),+ $(,)?])? ;) => {
        #[doc = $help]
        #[derive(Clone, Copy, Debug)]
        $visibility struct $Name;

        impl $crate::Registered for $Name {
            fn word(&self) -> &'static str {
                $word
            }

            fn help(&self) -> &'static str {
                $help.trim()
            }

            fn aliases(&self) -> &'static [&'static str] {
                &[$($alias),*]
            }

            fn parameters(&self) -> &'static [$crate::Parameter] {
                const PARAMETERS: &[$crate::Parameter] = &[$($($parameter),+)?];
                PARAMETERS
            }
        }
    };
}
