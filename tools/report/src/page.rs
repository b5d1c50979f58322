//! One HTML page of charts, tables, pictures and text: a description in, a file that needs nothing else out.
//!
//! The description is TOML. Every number of the page comes from a table: charts and tables are of CSV files, and a text
//! names its numbers. What the page holds:
//!
//! ```toml
//! title = "What order costs"
//! folder = ".."            # files are named from this folder, seen from the description's [default: its own]
//! command = "make run"     # makes the tables, where a section or block names no other
//! intro = "Scanline fetches {{ scan / hilbert | ,.0f }} times as much."
//!
//! [numbers]                # short names for numbers: FILE[COLUMN=VALUE, ...].COLUMN, of the one row that fits
//! scan = "out/all.csv[order=scanline].fetches_per_query"
//! hilbert = 'out/all.csv[order="scanline, hilbert"].fetches_per_query'
//!
//! [[section]]
//! heading = "Caches"       # also: id, command
//! text = "Markdown, with {{ out/all.csv[order=scanline].fetches | , }} and links such as [this](#caches)."
//!
//! [[section.chart]]        # all but tables, x and y may be left out
//! title = "Fetches and size"
//! tables = ["out/sizes.csv"]
//! x = "cache_bytes"
//! y = "fetches_per_query"
//! by = ["order"]           # else a series for each table
//! error = "half_width"
//! only = { lanes = "1", order = ["scanline", "hilbert"] }
//! reference = ["scripts/paper.csv"]
//! x_scale = "log2"         # auto, linear, log2, log10; so y_scale
//! points = true            # and frontier, x_label, y_label, text, id, command
//! data = ["fetches"]       # further columns for the data below it
//!
//! [[section.table]]        # all but tables may be left out
//! title = "Beside the paper"
//! tables = ["out/all.csv"]
//! only = { lanes = "1" }
//! sort = ["-fetches"]
//! join = [{ name = "paper", table = "scripts/paper.csv", on = ["order"] }]
//! columns = [
//!     "order",
//!     { column = "fetches_per_query", heading = "ours", format = ".3g", error = "half_width" },
//!     { column = "paper.value", heading = "paper" },
//!     { ratio = ["fetches_per_query", "paper.value"], heading = "ratio", format = ".2f" },
//! ]
//!
//! [[section.picture]]      # several, one after another, stand side by side
//! file = "out/cornell.png"
//! alt = "A box with two spheres"
//! caption = "The picture is the same for every order."
//!
//! [[section.paragraph]]    # a text between two blocks
//! heading = "What follows"
//! text = "Markdown"
//! ```
//!
//! `{{ ... }}` knows numbers, names, places in files, and `+ - * /` between blanks; behind `|` stands a [`Format`] as
//! Python has them: `.2f` decimals, `.3g` significant digits, `.1e`, `.1%`, `,` groups of thousands, `B` bytes. A single
//! place without a format is written as the file has it. In a text, a table and the data of a chart a number goes with the
//! column `found` (full, sampled, thinned) of its row, and below charts and tables stand their data, the command that made
//! them, and the `history` of their rows, where the tables have these columns.

mod below;
mod chart;
mod description;
mod expression;
mod format;
mod html;
mod markdown;
mod sheet;
mod table;
mod write;

pub use description::{
    Block, ChartBlock, Description, Join, Paragraph, PictureBlock, Section, Shown, ShownColumn, TableBlock, Values,
};
pub use format::Format;
pub use sheet::Sheets;

use thiserror::Error;

/// Why no page comes of a description.
#[derive(Debug, Error)]
#[error("{}{what}", .line.map_or(String::new(), |line| format!("line {line}: ")))]
pub struct PageError {
    /// The line of the description, the first being 1.
    line: Option<usize>,
    what: String,
    asked_wrongly: bool,
}

impl PageError {
    /// The description asks for what cannot be.
    fn asked(what: impl Into<String>) -> Self {
        Self { line: None, what: what.into(), asked_wrongly: true }
    }

    /// A file cannot be read, or does not hold what it should.
    fn read(what: impl Into<String>) -> Self {
        Self { asked_wrongly: false, ..Self::asked(what) }
    }

    /// The same, at this line of the description unless its place is known better.
    fn at_line(self, line: Option<usize>) -> Self {
        Self { line: self.line.or(line), ..self }
    }

    /// Is it the description that is wrong, and not a file that it names?
    #[must_use]
    pub const fn asked_wrongly(&self) -> bool {
        self.asked_wrongly
    }
}
