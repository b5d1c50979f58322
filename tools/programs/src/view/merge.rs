//! Parts put together: the very stream, or picture, that one machine would have made.

mod photons;
mod pictures;

use super::Args;
use super::pictures::is_picture;
use crate::cli::{Input, Progress, named, open_input, refuse_parts, usage};
use anyhow::Context as _;
use pm_formats::trace::{Access, TraceSink};
use pm_formats::{BlockReader, BlockWriter, Parts, StreamKind};
use std::path::Path;

/// Writes the whole of which all parts are given.
pub(super) fn merge(args: &Args) -> anyhow::Result<()> {
    if args.streams.iter().filter(|path| *path == Path::new("-")).count() > 1 {
        return Err(usage("standard input (`-`) can be read only once"));
    }
    if args.streams.iter().any(|path| is_picture(path)) {
        return pictures::merge(args);
    }
    let open = |path: &std::path::PathBuf| Ok((named(path), open_input(path)?));
    let parts: Vec<(String, BlockReader<Input>)> = args.streams.iter().map(open).collect::<anyhow::Result<_>>()?;
    if parts.iter().all(|(_, blocks)| blocks.kind() == StreamKind::UnroundedPhotons) {
        return photons::merge(args, parts);
    }
    let mut parts = Parts::new(parts).map_err(refuse_parts)?;
    let mut output = BlockWriter::new(args.output.create()?, parts.kind(), parts.header())?;
    let progress = Progress::new(parts.header().expected_records, "records", args.voice.quiet);
    while let Some(block) = parts.next_block(&mut Nobody).map_err(refuse_parts)? {
        output.write(&block)?;
        progress.add(block.meta.records.into());
    }
    drop(progress);
    let end = parts.end().map_err(refuse_parts)?;
    output.finish(&end).context("the whole")?.commit()
}

/// Whom searches are told that are only to be checked.
struct Nobody;

impl TraceSink for Nobody {
    fn access(&mut self, _: Access) {}
}
