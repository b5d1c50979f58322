//! How traces of other programs are read.

use crate::cli::{choice, entry};
use clap::Command;
use pm_exchange::traces::{Reading, References, TraceImport, assumed_sizes};
use pm_registry::Registry;

/// How traces of other programs are read.
#[derive(clap::Args)]
pub(super) struct ForeignArgs {
    /// Format of the traces; without it, as the content tells; gzip, zstd, xz, bzip2 or zip around it
    #[arg(long, value_name = "FORMAT", value_parser = entry(&pm_exchange::traces::imports()))]
    input: Option<&'static dyn TraceImport>,
    /// Bytes of every foreign access
    #[arg(long, value_name = "BYTES", hide_short_help = true)]
    access_size: Option<u32>,
    /// Bytes that 1 stands for in foreign addresses, such as the line where they are numbers of lines or objects
    #[arg(long, value_name = "BYTES", default_value = "1", hide_short_help = true, value_parser = clap::value_parser!(u64).range(1..))]
    address_unit: u64,
    /// What to simulate of a foreign trace that has instructions too
    #[arg(long, value_name = "WHICH", default_value = "data", hide_short_help = true, value_parser = choice::<References>())]
    references: References,
    /// Columns of a CSV file: address, size, kind, and _ for one to skip, or names of its own, such as address=lbn,size=len
    #[arg(long, value_name = "LIST", value_delimiter = ',', hide_short_help = true)]
    columns: Option<Vec<String>>,
}

impl ForeignArgs {
    /// The command of a program that has these arguments, where traces may be of these formats.
    pub(super) fn of_formats(command: Command, imports: &Registry<dyn TraceImport>) -> Command {
        let size = format!(
            "Bytes of every foreign access [default: as the trace says; where it does not, {}]",
            assumed_sizes(imports)
        );
        command
            .mut_arg("input", |argument| argument.value_parser(entry(imports)))
            .mut_arg("access_size", |argument| argument.help(size))
    }

    /// The same, for the reader of such traces.
    pub(super) fn reading(&self) -> Reading {
        Reading {
            format: self.input,
            access_size: self.access_size,
            address_unit: self.address_unit,
            columns: self.columns.clone(),
            references: self.references,
        }
    }

    /// What to say of so many references that were left out, if there is anything to say.
    pub(super) fn left_out(&self, number: u64) -> Option<String> {
        let what = if self.references == References::Data { "instructions" } else { "data accesses" };
        (number > 0).then(|| format!("{number} {what} left out (--references all)"))
    }
}
