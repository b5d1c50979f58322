//! A trace to be replayed: one stream, or all parts of one.

use crate::cli::refuse_parts;
use pm_formats::trace::{TraceReader, TraceSink};
use pm_formats::vocabulary::meaning;
use pm_formats::{BlockMeta, BlockReader, End, Error, Header, Parts, StreamKind, part_of};
use std::io::Read;

/// A trace, however it is stored.
pub(super) enum Replay<R> {
    /// One stream.
    One(Box<TraceReader<R>>),
    /// All its parts, read together as the one stream that they are parts of: caches go on from batch to batch.
    Parts(Parts<R>),
}

impl<R: Read> Replay<R> {
    /// Of these parts.
    pub(super) fn of_parts(parts: Vec<(String, BlockReader<R>)>) -> anyhow::Result<Self> {
        let parts = Parts::new(parts).map_err(refuse_parts)?;
        match parts.kind() {
            StreamKind::Trace => Ok(Self::Parts(parts)),
            other => {
                let (found, wanted) = (other.plural(), StreamKind::Trace.plural());
                Err(Error::WrongKind { found, wanted }.into())
            }
        }
    }

    /// What the trace is about.
    pub(super) fn header(&self) -> &Header {
        match self {
            Self::One(trace) => trace.header(),
            Self::Parts(parts) => parts.header(),
        }
    }

    /// Replays the next block; nothing at the end.
    pub(super) fn replay_block(&mut self, sink: &mut impl TraceSink) -> anyhow::Result<Option<BlockMeta>> {
        match self {
            Self::One(trace) => Ok(trace.replay_block(sink)?),
            Self::Parts(parts) => Ok(parts.next_block(sink).map_err(refuse_parts)?.map(|block| block.meta)),
        }
    }

    /// The end block, after the end.
    pub(super) fn end(&self) -> anyhow::Result<End> {
        match self {
            Self::One(trace) => Ok(trace.end()?.clone()),
            Self::Parts(parts) => parts.end().map_err(refuse_parts),
        }
    }
}

/// Parts that were given one after the other and wait for the rest of their stream.
pub(super) struct Waiting<R>(Vec<(String, BlockReader<R>)>);

impl<R: Read> Waiting<R> {
    pub(super) const fn new() -> Self {
        Self(vec![])
    }

    /// Whether a stream is a part, which has to wait for the others.
    pub(super) fn takes(blocks: &BlockReader<R>) -> bool {
        blocks.header().meaning(meaning::PART).is_some()
    }

    /// One more part. If all are there that the first one speaks of, their names and their trace.
    pub(super) fn add(&mut self, name: String, blocks: BlockReader<R>) -> anyhow::Result<Option<(String, Replay<R>)>> {
        self.0.push((name, blocks));
        match part_of(self.0[0].1.header()) {
            Some(part) if (self.0.len() as u64) < part.of() => Ok(None),
            _ => self.rest(),
        }
    }

    /// The names and the trace of those that wait, if any do.
    pub(super) fn rest(&mut self) -> anyhow::Result<Option<(String, Replay<R>)>> {
        match std::mem::take(&mut self.0) {
            none if none.is_empty() => Ok(None),
            parts => {
                let names: Vec<&str> = parts.iter().map(|(name, _)| name.as_str()).collect();
                let names = names.join(" ");
                Ok(Some((names, Replay::of_parts(parts)?)))
            }
        }
    }
}
