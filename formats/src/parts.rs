//! Parts of a stream, read together as the very stream that one machine would have made.
//!
//! Batches are dealt out like cards ([`Part::has`](crate::vocabulary::Part::has)), and no block holds records of two of
//! them: the whole has the blocks of all parts, by their batches. Cached irradiance stands whole in every part.

mod end;
mod error;
mod header;
mod history;
mod rules;
mod source;
#[cfg(test)]
mod tests;

pub use error::PartsError;
pub use header::{each_part_once, part_of, whole_header};

use crate::container::{Block, BlockReader, End, Header, Section, StreamKind};
use crate::digest::Tally;
use crate::trace::TraceSink;
use source::Source;
use std::io::Read;

/// All parts of a stream of queries or of a trace, read together.
pub struct Parts<R> {
    header: Header,
    kind: StreamKind,
    /// First part first.
    sources: Vec<Source<R>>,
    /// Have tables beside the records been passed?
    begun: bool,
    tally: Tally,
}

impl<R: Read> Parts<R> {
    /// Puts parts together, in whatever order they are given, each with its name for messages.
    ///
    /// # Errors
    /// [`PartsError`] if they are not all parts of one stream, each once.
    pub fn new(parts: Vec<(String, BlockReader<R>)>) -> Result<Self, PartsError> {
        let headers: Vec<_> =
            parts.iter().map(|(name, blocks)| (name.as_str(), blocks.kind(), blocks.header())).collect();
        let (kind, header) = whole_header(&headers)?;
        if matches!(kind, StreamKind::Photons | StreamKind::UnroundedPhotons) {
            return Err(PartsError::Unfit("photons of parts are put together path by path".into()));
        }
        let sources: Result<Vec<_>, _> = parts.into_iter().map(|(name, blocks)| Source::new(name, blocks)).collect();
        let mut sources = sources?;
        sources.sort_by_key(|source| source.part.number());
        Ok(Self { header, kind, sources, begun: false, tally: Tally::default() })
    }

    /// The header of the whole.
    #[must_use]
    pub const fn header(&self) -> &Header {
        &self.header
    }

    /// What the parts hold.
    #[must_use]
    pub const fn kind(&self) -> StreamKind {
        self.kind
    }

    /// The next block of the whole; searches are replayed into `sink`. `None` at its end: then every part was whole.
    ///
    /// # Errors
    /// [`PartsError`] if a part is damaged, or holds what is not its own.
    pub fn next_block(&mut self, sink: &mut impl TraceSink) -> Result<Option<Block>, PartsError> {
        if !self.begun {
            if let Some(block) = self.next_beside()? {
                return Ok(Some(block));
            }
            self.begun = true;
        }
        let mut next: Option<(usize, u64)> = None;
        for (at, source) in self.sources.iter_mut().enumerate() {
            if let Some(batch) = source.batch()?
                && next.is_none_or(|(_, least)| batch < least)
            {
                next = Some((at, batch));
            }
        }
        let Some((at, _)) = next else { return Ok(None) };
        let taken = self.sources[at].take(sink)?;
        self.tally += taken.1;
        Ok(Some(taken.0))
    }

    /// The next block of tables beside the records, which all parts have alike.
    fn next_beside(&mut self) -> Result<Option<Block>, PartsError> {
        let mut all: Option<Option<(Block, Tally)>> = None;
        for source in &mut self.sources {
            let beside = source.take_beside()?;
            match &all {
                None => all = Some(beside),
                Some(first) if *first == beside => {}
                Some(_) => {
                    let name = &source.name;
                    return Err(PartsError::Unfit(format!("{name}: its cached irradiance is not that of the others")));
                }
            }
        }
        let Some((block, tally)) = all.flatten() else { return Ok(None) };
        debug_assert_ne!(block.section, Section::Records);
        self.tally += tally;
        Ok(Some(block))
    }

    /// The end of the whole, after [`next_block`](Self::next_block) has returned `None`.
    ///
    /// # Errors
    /// [`PartsError`] before that, or if the parts measured what does not go together.
    pub fn end(&self) -> Result<End, PartsError> {
        let ends = self.sources.iter().map(Source::end).collect::<Result<Vec<_>, _>>()?;
        Ok(End { tally: self.tally, stages: end::whole_stages(&ends)? })
    }
}
