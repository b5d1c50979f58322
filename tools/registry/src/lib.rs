//! What can be chosen by a word: on a command line, in a table, in an error.
//!
//! A [`Choice`] is a closed set, an `enum` made by [`choices!`]: each line is a variant, its word and what is said of it.
//! A [`Registry`] is an open one: a list of things that each know their own word, to which a line adds one more. From that
//! line come the word on the command line, the help, the error text, the row in a table of documentation, and the place in
//! every test that says "for every". An entry may declare [`Parameter`]s, options of its own: data from which command lines
//! are made, and which are understood here, so that nothing else needs to know what they are.
//!
//! ```
//! use pm_registry::{Domain, Parameter, Registry};
//!
//! /// What all tools are: the trait of the registry's entries.
//! trait Tool: pm_registry::Registered {
//!     fn strokes(&self, teeth: u32) -> u32;
//! }
//!
//! pm_registry::registered! {
//!     /// Cuts wood
//!     pub struct Saw = "saw" with [Parameter::new("teeth", Domain::count(1, 99), "teeth an inch").or("7")];
//! }
//!
//! impl Tool for Saw {
//!     fn strokes(&self, teeth: u32) -> u32 {
//!         100 / teeth
//!     }
//! }
//!
//! let tools: Registry<dyn Tool> = Registry::new("tool", &[&Saw]);
//! let chosen = tools.choose("saw --teeth 10").unwrap();
//! assert_eq!(chosen.entry.strokes(chosen.values.count("teeth")), 10);
//! let said = |line: &str| tools.choose(line).err().unwrap().to_string();
//! assert_eq!(said("sew"), "`sew` is no tool: there are saw");
//! assert_eq!(said("saw --teeth 0"), "--teeth 0: a whole number from 1 to 99 is expected");
//! assert_eq!(said("saw --edge 3"), "saw takes no --edge: leave --edge out");
//! ```

mod choice;
mod chosen;
mod error;
mod parameter;
mod registered;
mod registry;
mod shared;
mod value;
mod values;

pub use choice::{Choice, Named};
pub use chosen::Chosen;
pub use error::{ChoiceError, ParameterError, UnknownWord};
pub use parameter::{Domain, Parameter, Word, words_of};
pub use registered::Registered;
pub use registry::Registry;
pub use shared::Shared;
pub use value::Value;
pub use values::Values;
