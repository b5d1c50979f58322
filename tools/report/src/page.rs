//! One HTML page of charts, tables, pictures and text: a description in, a file that needs nothing else out.
//!
//! The description is TOML. Every number of the page comes from a table: charts and tables are of CSV files, and a text
//! names its numbers. What the page holds:
//!
//! ```toml
//! title = "What order costs"
//! folder = ".."            # files are named from this folder, seen from the description's [default: its own]
//! command = "make run"     # makes the tables, where a section or block names no other
//! about = { name = "The paper", address = "https://example.org" }   # below the intro: the only link out of the page
//! intro = "Scanline fetches {{ scan / hilbert | ,.0f }} times as much."
//!
//! [numbers]                # short names for numbers: row(FILE, COLUMN=VALUE, ...).COLUMN, of the one row that fits
//! scan = "row('out/all.csv', order='scanline').fetches_per_query"
//! hilbert = "row('out/all.csv', order='scanline, hilbert').fetches_per_query"
//!
//! [bars]                   # what tells the story first: a few numbers on a logarithmic scale
//! title = "Bytes fetched"
//! bar = [{ label = "scanline", value = "scan * 128", text = "{{ scan * 128 | B }}" }]
//!
//! [[section]]
//! heading = "Caches"       # also: id, command
//! text = "Markdown, with {{ row('out/all.csv', order='scanline').fetches | , }} and links such as [this](#caches)."
//!
//! [[section.chart]]        # all but tables, x and y may be left out; more than seven series become several drawings
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
//! folded = true            # behind its title until that is clicked; tables too
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
//! What stands in `{{ ... }}` is an [`expression`](crate::expression); behind `|` stands a [`NumberFormat`] as
//! Python has them: `.2f` decimals, `.3g` significant digits, `.1e`, `.1%`, `,` groups of thousands, `B` bytes. A single
//! place without a format is written as the file has it. In a text, a table and the data of a chart a number goes with the
//! column `found` (full, sampled, thinned) of its row, and below charts and tables stand their data, the command that made
//! them, and the `history` of their rows, where the tables have these columns.

mod bars;
mod below;
mod blocks;
mod chart;
mod description;
mod html;
mod ids;
mod markdown;
mod number_format;
mod picture;
mod table;
mod writer;
mod written;

pub use bars::{Bar, Bars};
pub use blocks::{ChartBlock, Join, Paragraph, PictureBlock, Shown, ShownColumn, TableBlock};
pub use description::{About, Block, Description, Section};
pub use number_format::NumberFormat;
