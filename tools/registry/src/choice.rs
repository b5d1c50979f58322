//! Closed sets of words.

/// One of a closed set of things, each of which has a word.
pub trait Choice: Copy + PartialEq + Send + Sync + 'static {
    /// All of them, in the order in which they are listed.
    const ALL: &'static [Named<Self>];

    /// The entry of this one.
    ///
    /// # Panics
    /// Never: every value has an entry.
    #[must_use]
    fn named(self) -> &'static Named<Self> {
        Self::ALL.iter().find(|named| named.value == self).expect("every variant has a line")
    }

    /// The word by which this one is chosen.
    #[must_use]
    fn word(self) -> &'static str {
        self.named().word
    }

    /// The one with this word, if there is one; words are told apart as they are written.
    #[must_use]
    fn of_word(word: &str) -> Option<Self> {
        Self::ALL.iter().find(|named| named.word == word || named.aliases.contains(&word)).map(|named| named.value)
    }
}

/// A thing with its word.
#[derive(Clone, Copy, Debug)]
pub struct Named<T> {
    /// The thing.
    pub value: T,
    /// The word that is listed.
    pub word: &'static str,
    /// Words that are understood as well.
    pub aliases: &'static [&'static str],
    /// What is said of it, a line of documentation as it stands in the source.
    help: &'static str,
}

impl<T> Named<T> {
    /// An entry; `help` may begin with the blank that stands behind `///`.
    #[must_use]
    pub const fn new(value: T, word: &'static str, aliases: &'static [&'static str], help: &'static str) -> Self {
        Self { value, word, aliases, help }
    }

    /// What is said of it.
    #[must_use]
    pub fn help(&self) -> &'static str {
        self.help.trim()
    }
}

/// Makes an `enum` whose variants are chosen by words: `Variant = "word"` with the documentation of the variant as its
/// help; `Variant = "word" | "alias"` understands another word as well.
///
/// ```
/// pm_registry::choices! {
///     /// How much is said.
///     #[derive(Debug, Default)]
///     pub enum Talk {
///         /// Nothing
///         None = "none",
///         /// All that is known
///         #[default]
///         All = "all" | "everything",
///     }
/// }
/// use pm_registry::Choice;
/// assert_eq!(Talk::of_word("everything"), Some(Talk::All));
/// assert_eq!((Talk::None.word(), Talk::All.named().help()), ("none", "All that is known"));
/// ```
#[macro_export]
macro_rules! choices {
    ($(#[$meta:meta])* $visibility:vis enum $Name:ident {
        $( #[doc = $help:literal] $(#[$attribute:meta])* $Variant:ident = $word:literal $(| $alias:literal)* ),+ $(,)?
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, PartialEq, Eq)]
        $visibility enum $Name {
            $( #[doc = $help] $(#[$attribute])* $Variant, )+
        }

        impl $crate::Choice for $Name {
            const ALL: &'static [$crate::Named<Self>] =
                &[$( $crate::Named::new(Self::$Variant, $word, &[$($alias),*], $help) ),+];
        }
    };
}
