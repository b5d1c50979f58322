//! Experiments as tables: each line stands for points of a sweep, each point for a command that make runs and a row it gives.
//!
//! [`Table`] reads a table and [`Words`] what its words mean, [`Sweep`] has its points, [`rules`](rules::rules) turns these
//! into rules for make, and [`join`](join::join) puts their rows together. What nobody uses is refused with its line: a column
//! that does nothing would name results by something that they do not depend on. `scripts/README.md` says how a table is written.

mod believed;
mod check;
mod error;
pub mod join;
mod line;
mod make;
mod names;
mod number;
mod pipe;
mod place;
mod point;
pub mod progress;
pub mod rows;
pub mod rules;
mod stage;
mod sweep;
mod table;
mod template;
pub mod until;
mod words;
mod work;

pub use believed::believed;
pub use error::{SweepError, TableError};
pub use number::significant;
pub use place::placed;
pub use point::Point;
pub use stage::Stage;
pub use sweep::Sweep;
pub use table::{Column, Line, Table};
pub use words::Words;
pub use work::{Stream, Work};
