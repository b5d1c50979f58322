//! `pm-view`: looks into streams, at what they are about, where they came from, whether they are whole, what their records
//! say; compares pictures; reads and writes other programs' data.

mod archive;
mod args;
mod export;
mod header;
mod import;
mod look;
mod merge;
mod pictures;
mod seeds;
mod tables;
mod whole;

pub use args::Args;

use crate::cli::{Program, Typed, create_output, entry, named, open_input, usage};
use crate::foreign_args::ForeignArgs;
use anyhow::Context as _;
use args::Rows;
use clap::{CommandFactory as _, FromArgMatches as _};
use pictures::is_picture;
use pm_exchange::traces::TraceExport;
use pm_registry::Registry;
use std::path::Path;

/// The program, where traces may be written in these formats.
#[must_use]
pub fn program(exports: &Registry<dyn TraceExport>) -> Program<Args> {
    let command = ForeignArgs::of_formats(Args::command(), &pm_exchange::traces::imports());
    // Its short help is of streams.
    let command = command.mut_arg("input", |argument| argument.hide_short_help(true));
    let command = command.mut_arg("export", |argument| argument.value_parser(entry(exports)));
    Program::new("pm-view", command, Args::from_arg_matches)
}

/// Does what is asked.
///
/// # Errors
/// Whatever is wrong with the question, an input or the output.
pub fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    if args.import != Some(Rows::Trace) && args.foreign.are_given() {
        return Err(usage("--input and how a trace is read belong to --import trace"));
    }
    if let Some(what) = args.import {
        return import::import(what, &args, typed);
    }
    if args.merge {
        return merge::merge(&args);
    }
    if args.archive {
        return archive::archive(&args);
    }
    if let Some(sheet) = &args.sheet {
        return pictures::make_sheet(sheet, &args);
    }
    if let Some(format) = args.export {
        return export::export(format, &args);
    }
    let pictures = args.streams.iter().filter(|path| is_picture(path)).count();
    if !args.mean.is_empty() && pictures < args.streams.len() {
        return Err(usage("--mean measures .exr pictures"));
    }
    if let Some(preview) = args.streams.iter().find(|path| pictures::is_preview(path)) {
        return Err(usage(format!(
            "{}: PNG previews have lost what is compared; give the .exr pictures (--sheet takes both)",
            preview.display()
        )));
    }
    let of_streams = args.history || args.check || args.records.is_some();
    if args.mean.is_empty() && pictures > 0 && (pictures > 2 || pictures < args.streams.len() || of_streams) {
        return Err(usage(
            "pictures are described one at a time or compared two at a time, without other options; --mean and --sheet take more",
        ));
    }
    let of_the_table = args.output.output.as_deref().filter(|_| pictures != 2 || !pictures::wants_difference(&args));
    let mut output = create_output(of_the_table.unwrap_or(Path::new("-")))?;
    match &args.streams[..] {
        _ if !args.mean.is_empty() => pictures::measure(&args, &mut output)?,
        [picture] if pictures == 1 => pictures::describe(picture, &mut output)?,
        [a, b] if pictures == 2 => pictures::compare(a, b, &args, &mut output)?,
        streams => {
            for path in streams {
                let name = named(path);
                let stream = open_input(path)?;
                look::look(&args, &name, stream, &mut output).with_context(|| name.clone())?;
            }
        }
    }
    output.commit()
}
