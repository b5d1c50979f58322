//! How traces of other programs are read.

use crate::cli::{choice, entry, usage};
use clap::Command;
use pm_exchange::traces::{Part, Reading, References, TraceImport, assumed_sizes};
use pm_registry::Registry;

/// How traces of other programs are read.
#[derive(clap::Args)]
pub(crate) struct ForeignArgs {
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
    /// Leave out the first N foreign accesses
    #[arg(long, value_name = "N", default_value = "0", hide_short_help = true)]
    skip: u64,
    /// Simulate the next N foreign accesses without counting them
    #[arg(long, value_name = "N", default_value = "0", hide_short_help = true)]
    warm_up: u64,
    /// Count the next N foreign accesses and no more
    #[arg(long, value_name = "N", hide_short_help = true, value_parser = clap::value_parser!(u64).range(1..))]
    take: Option<u64>,
}

impl ForeignArgs {
    /// The command of a program that has these arguments, where traces may be of these formats.
    pub(crate) fn of_formats(command: Command, imports: &Registry<dyn TraceImport>) -> Command {
        let size = format!(
            "Bytes of every foreign access [default: as the trace says; where it does not, {}]",
            assumed_sizes(imports)
        );
        command
            .mut_arg("input", |argument| argument.value_parser(entry(imports)))
            .mut_arg("access_size", |argument| argument.help(size))
    }

    /// The same, for the reader of such traces.
    pub(crate) fn reading(&self, columns: Option<&[String]>) -> Reading {
        Reading {
            format: self.input,
            access_size: self.access_size,
            address_unit: self.address_unit,
            columns: columns.map(<[String]>::to_vec),
            references: self.references,
            part: self.part(),
        }
    }

    fn part(&self) -> Part {
        Part { skip: self.skip, warm_up: self.warm_up, take: self.take }
    }

    /// Refuses what a trace of ours has no use for.
    ///
    /// # Errors
    /// If it was asked.
    pub(crate) fn refuse_of_ours(&self) -> anyhow::Result<()> {
        match self.part().is_whole() {
            true => Ok(()),
            false => Err(usage(
                "--skip, --warm-up and --take are for traces of other programs; of ours pm-sample takes parts",
            )),
        }
    }

    /// Whether anything was asked that is not so by itself.
    pub(crate) fn are_given(&self) -> bool {
        let asked = self.input.is_some() || self.access_size.is_some() || self.address_unit != 1;
        asked || self.references != References::Data || !self.part().is_whole()
    }

    /// What to say of so many references that were left out, if there is anything to say.
    pub(crate) fn left_out(&self, number: u64) -> Option<String> {
        let what = if self.references == References::Data { "instructions" } else { "data accesses" };
        (number > 0).then(|| format!("{number} {what} left out (--references all)"))
    }
}
