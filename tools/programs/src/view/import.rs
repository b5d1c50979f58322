//! A stream of another renderer's photons or gather points, or of another simulator's trace.

use super::Args;
use super::args::Rows;
use crate::cli::{Typed, named, open_bytes, usage};
use anyhow::Context as _;
use pm_exchange::rows::{self, Imported, RowOptions};
use pm_exchange::traces::{self, Opened};
use pm_formats::{Record, Step};
use std::path::Path;

/// Makes a stream of the rows of the one file there is.
pub(super) fn import(what: Rows, args: &Args, typed: &Typed) -> anyhow::Result<()> {
    let [path] = &args.streams[..] else {
        return Err(usage("--import reads one file"));
    };
    match what {
        Rows::Trace if args.size.is_some() || args.emitted.is_some() || args.raw.is_some() => {
            return Err(usage(
                "--size, --emitted and --raw belong to photons and queries; --input names the format of a trace",
            ));
        }
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
    if what == Rows::Trace {
        return import_trace(path, args, step);
    }
    let input = open_bytes(path)?;
    match what {
        Rows::Photons => write(rows::photons(input, &options, step).context(name)?, args),
        Rows::Queries => write(rows::queries(input, &options, step).context(name)?, args),
        Rows::Trace => unreachable!("done above"),
    }
}

/// Makes a stream of another simulator's trace.
fn import_trace(path: &Path, args: &Args, step: Step) -> anyhow::Result<()> {
    let name = named(path);
    let reading = args.foreign.reading(args.columns.as_deref());
    let opened = traces::open(open_bytes(path)?, &reading, &traces::imports()).context(name.clone())?;
    let Opened::Foreign(mut trace) = opened else {
        return Err(usage(format!("{name} is a stream of ours already")));
    };
    let header = traces::header_of(&trace, step);
    let output = traces::archive(&mut trace, &header, args.output.create()?).context(name.clone())?;
    if let Some(remark) = args.foreign.left_out(trace.left_out()) {
        args.voice.remark(format!("{name}: {remark}"));
    }
    output.commit()
}

fn write<T: Record>(imported: Imported<T>, args: &Args) -> anyhow::Result<()> {
    if !imported.unused.is_empty() {
        args.voice.remark(format!("columns that are not used: {}", imported.unused.join(", ")));
    }
    imported.write(args.output.create()?)?.commit()
}
