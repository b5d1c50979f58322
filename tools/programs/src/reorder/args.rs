//! What `pm-reorder` may be asked.

use crate::cli::{Chooser, OutputArgs, Voice, choice};
use clap::{Arg, ArgMatches, Args as _, Command, FromArgMatches as _};
use pm_orders::{Order, Per, StoredQuery};
use pm_registry::{Chosen, Registry};
use pm_size::Bytes;
use std::path::PathBuf;

/// What was asked.
pub(super) struct Args {
    pub(super) order: Chosen<dyn Order>,
    pub(super) first: First,
    pub(super) rest: Rest,
}

/// What stands before the parameters of orders.
#[derive(clap::Args)]
pub(super) struct First {
    /// Queries to read; `-` is standard input
    #[arg(default_value = "-")]
    pub(super) queries: PathBuf,
    /// Reorder each batch (tile, scanline) by itself, or the whole image
    #[arg(long, default_value = "image", value_parser = choice::<Per>())]
    pub(super) per: Per,
    /// Bytes of the store on chip; queries beyond are written to memory and read back, which is counted
    #[arg(long, value_name = "SIZE", default_value = "1M")]
    pub(super) storage: Bytes,
    /// What is stored of a query while it waits, as far as is counted
    #[arg(long, default_value = "full", value_parser = choice::<StoredQuery>())]
    pub(super) record: StoredQuery,
}

/// What stands behind them.
#[derive(clap::Args)]
pub(super) struct Rest {
    /// Memory of this machine to sort in; beyond it, temporary files (TMPDIR) are used. The output is the same
    #[arg(long, value_name = "SIZE", default_value = "2G", value_parser = memory)]
    pub(super) memory: Bytes,
    #[command(flatten)]
    pub(super) output: OutputArgs,
    #[command(flatten)]
    pub(super) voice: Voice,
}

const ABOUT: &str = "Reorder gather queries so that neighbours in space become neighbours in time";
const MORE: &str = "\
The same queries come out, which the digest at the end of the stream proves; only their order, and with it the memory \
traffic of their searches, is another. What the order itself costs stands in the end block (`pm-view`): queries held, bytes \
on chip, and bytes written to memory and read back because the store on chip is too small.

The Hilbert curve is Skilling's (2004), of ten bits a coordinate, whose first step goes along z; in Morton's keys x has the \
highest bit of each three. Other programs have other curves of these names.";

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-queries --order tiled | pm-reorder hilbert --per batch -o tiled-hilbert.pmq
  pm-reorder snowplow --storage 256K --record compact q.pmq | pm-gather map.pmp | pm-cachesim
  pm-queries --order tiled --tile 128 | pm-reorder cells --photons map.pmp --per batch | pm-gather";

/// Least memory to sort in.
const LEAST_MEMORY: u64 = 64 << 10;

fn memory(text: &str) -> Result<Bytes, String> {
    let bytes: Bytes = text.parse().map_err(|error: pm_size::SizeError| error.to_string())?;
    if bytes.0 < LEAST_MEMORY { Err(format!("at least {} is needed", Bytes(LEAST_MEMORY))) } else { Ok(bytes) }
}

/// The command line with these orders, and how it is understood.
pub(super) fn command(
    orders: &Registry<dyn Order>,
) -> (Command, impl FnOnce(&ArgMatches) -> Result<Args, clap::Error> + use<>) {
    let orders = Chooser::positional(orders, Arg::new("order").value_name("ORDER").help("How to order the queries"));
    let command = First::augment_args(orders.add_word(Command::new("pm-reorder")));
    let command = Rest::augment_args(orders.add_parameters(command));
    let command = command.about(ABOUT).long_about(format!("{ABOUT}.\n\n{MORE}")).after_help(EXAMPLES);
    let read = move |matches: &ArgMatches| {
        Ok(Args {
            order: orders.read(matches)?,
            first: First::from_arg_matches(matches)?,
            rest: Rest::from_arg_matches(matches)?,
        })
    };
    (command, read)
}
