//! Tables of results, written for people or for programs; charts of them, and pages.
//!
//! A [`Table`] is columns and rows of [`Value`]s; [`Table::write`] writes it in one of three formats:
//!
//! * `table`: aligned columns. Numbers carry no thousands separators and no scaled units, so that they can be copied and
//!   compared; a unit stands in the name of the column (`bytes_per_query`).
//! * `csv`: RFC 4180 quoting, one line of names, lines ended by `\n`, every integer exact and every ratio with all the
//!   digits it has.
//! * `json`: one object, `{"schema": 1, "columns": [names], "rows": [{name: value, ...}, ...]}`.
//!
//! A ratio that does not exist, such as fetches per query of no queries, is `-`, an empty field and `null`.
//!
//! A [`Sheet`](sheet::Sheet) is such a table read back. [`expression`] reckons with the numbers of sheets, [`chart`] draws
//! them, and [`page`] puts them on a page.

pub mod chart;
pub mod error;
pub mod expression;
pub mod page;
mod printable;
pub mod sheet;
mod table;

pub use error::ReportError;
pub use printable::printable;
/// The same by its earlier name.
pub use table::TableFormat as Format;
pub use table::{Align, Column, JSON_SCHEMA, Table, TableFormat, Value};
