//! How traces of other programs are read.

use pm_exchange::foreign::{Form, Reading, References};
use pm_programs::cli::choice;

/// How traces of other programs are read.
#[derive(clap::Args)]
pub(crate) struct ForeignArgs {
    /// Bytes of every foreign access [default: as the trace says; where it does not, din 4 and the address that of a
    /// word, dramsim3 and ramulator2 64, others 1]
    #[arg(long, value_name = "BYTES", hide_short_help = true)]
    access_size: Option<u32>,
    /// Bytes that 1 stands for in foreign addresses, such as the line where they are numbers of lines or objects
    #[arg(long, value_name = "BYTES", default_value = "1", hide_short_help = true, value_parser = clap::value_parser!(u64).range(1..))]
    address_unit: u64,
    /// What to simulate of a foreign trace that has instructions too
    #[arg(long, value_name = "WHICH", default_value = "data", hide_short_help = true, value_parser = choice::<References>())]
    references: References,
    /// Columns of a csv file without names: address, size, kind, and _ for one to skip
    #[arg(long, value_name = "LIST", value_delimiter = ',', hide_short_help = true)]
    columns: Option<Vec<String>>,
}

impl ForeignArgs {
    /// The same, for the reader of such traces; `form` if it is named.
    pub(crate) fn reading(&self, form: Option<Form>) -> Reading {
        Reading {
            form,
            access_size: self.access_size,
            address_unit: self.address_unit,
            columns: self.columns.clone(),
            references: self.references,
        }
    }

    /// What to say of so many references that were left out, if there is anything to say.
    pub(crate) fn left_out(&self, number: u64) -> Option<String> {
        let what = if self.references == References::Data { "instructions" } else { "data accesses" };
        (number > 0).then(|| format!("{number} {what} left out (--references all)"))
    }
}
