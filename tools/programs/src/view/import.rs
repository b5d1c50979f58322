//! A stream of another renderer's photons or gather points.

use super::Args;
use super::args::Rows;
use crate::cli::{Typed, named, open_bytes, usage};
use anyhow::Context as _;
use pm_exchange::rows::{self, Imported, RowOptions};
use pm_formats::Record;
use std::io::BufReader;

/// Makes a stream of the rows of the one file there is.
pub(super) fn import(what: Rows, args: &Args, typed: &Typed) -> anyhow::Result<()> {
    let [path] = &args.streams[..] else {
        return Err(usage("--import reads one file"));
    };
    match what {
        Rows::Photons if args.size.is_some() => {
            return Err(usage("--size belongs to queries; photons have no picture"));
        }
        Rows::Queries if args.emitted.is_some() => return Err(usage("--emitted belongs to photons")),
        _ => {}
    }
    let options = RowOptions {
        columns: args.columns.clone(),
        raw: args.raw.is_some(),
        emitted: args.emitted.unwrap_or(1),
        size: args.size,
    };
    let name = named(path);
    let step = typed.step_from(path, None);
    let input = BufReader::with_capacity(1 << 18, open_bytes(path)?);
    match what {
        Rows::Photons => write(rows::photons(input, &options, step).context(name)?, args),
        Rows::Queries => write(rows::queries(input, &options, step).context(name)?, args),
    }
}

fn write<T: Record>(imported: Imported<T>, args: &Args) -> anyhow::Result<()> {
    if !imported.unused.is_empty() {
        args.voice.remark(format!("columns that are not used: {}", imported.unused.join(", ")));
    }
    imported.write(args.output.create()?)?.commit()
}
