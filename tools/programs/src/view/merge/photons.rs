//! Photons of all parts: numbered path by path, and their powers rounded by their numbers.

use super::Args;
use crate::cli::{Input, Progress, refuse_parts, usage};
use crate::photons::PATHS;
use anyhow::{Context as _, bail};
use pm_formats::vocabulary::{Part, measure};
use pm_formats::{
    BlockMeta, BlockReader, Header, Number, RecordReader, StageReport, UnroundedPhoton, part_of, whole_header,
};
use pm_light::transport::photon_rounding;
use std::iter::Peekable;
use std::vec::IntoIter;

/// Writes the photons that one machine would have stored.
pub(super) fn merge(args: &Args, parts: Vec<(String, BlockReader<Input>)>) -> anyhow::Result<()> {
    let headers: Vec<_> = parts.iter().map(|(name, part)| (name.as_str(), part.kind(), part.header())).collect();
    let (_, header) = whole_header(&headers).map_err(refuse_parts)?;
    let mut parts: Vec<Source> =
        parts.into_iter().map(|(name, blocks)| Source::new(name, blocks)).collect::<anyhow::Result<_>>()?;
    parts.sort_by_key(|source| source.part.number());
    let (wanted, seed, program) = asked(&header)?;

    let mut output = args.output.begin(&header)?;
    let progress = Progress::new(Some(wanted), "photons", args.voice.quiet);
    let (mut stored, mut emitted) = (0, 0);
    let mut packed = vec![];
    for batch in 0.. {
        if stored >= wanted {
            break;
        }
        let number = parts.len() as u64;
        let source = &mut parts[usize::try_from(batch % number)?];
        let photons = source.batch(batch)?;
        packed.clear();
        let mut path = None;
        emitted = (batch + 1) * PATHS;
        for photon in &photons {
            // Whole paths, until there are enough.
            if path != Some(photon.path) && stored >= wanted {
                break;
            }
            path = Some(photon.path);
            let Some(photon) = photon.rounded(photon_rounding(seed, stored)) else {
                bail!("the power of photon {stored} is beyond what a photon can hold; is the light's Ke right?");
            };
            packed.push(photon);
            stored += 1;
        }
        if let Some(last) = path.filter(|_| stored >= wanted) {
            emitted = batch * PATHS + u64::from(last) + 1;
        }
        output.write(BlockMeta::default(), &packed)?;
        progress.add(packed.len() as u64);
    }
    drop(progress);
    for source in &mut parts {
        source.finish()?;
    }
    let report = StageReport::new(&program)
        .with("photons", Number::Count(stored))
        .with(measure::EMITTED_PATHS, Number::Count(emitted));
    output.finish(vec![report])?.commit()
}

/// How many photons were asked for, with which seed, of which program.
fn asked(header: &Header) -> anyhow::Result<(u64, u64, String)> {
    let step = header.history.first();
    let asked = header.expected_records.zip(step.and_then(|step| Some((step.seed?, step.program.clone()))));
    let (wanted, (seed, program)) = asked
        .ok_or_else(|| usage("the parts do not say how many photons were asked for; were they made by pm-photons?"))?;
    Ok((wanted, seed, program))
}

/// A part, batch by batch.
struct Source {
    name: String,
    part: Part,
    reader: RecordReader<UnroundedPhoton, Input>,
    /// The block in hand: its batch and what is left of it.
    batch: u64,
    photons: Peekable<IntoIter<UnroundedPhoton>>,
}

impl Source {
    fn new(name: String, blocks: BlockReader<Input>) -> anyhow::Result<Self> {
        let part = part_of(blocks.header()).ok_or_else(|| usage(format!("{name}: not a part of a stream")))?;
        let reader = RecordReader::from_blocks(blocks).with_context(|| name.clone())?;
        Ok(Self { name, part, reader, batch: 0, photons: vec![].into_iter().peekable() })
    }

    /// The photons of a batch, which may have none.
    fn batch(&mut self, batch: u64) -> anyhow::Result<Vec<UnroundedPhoton>> {
        let mut photons = vec![];
        loop {
            if self.photons.peek().is_none() && !self.read()? {
                let traced = self.traced()?;
                if (batch / self.part.of() + 1).saturating_mul(PATHS) > traced {
                    return Err(usage(format!(
                        "{}: part {} ends before the photons that are wanted are together; make all parts again with another N",
                        self.name, self.part
                    )));
                }
                return Ok(photons);
            }
            if self.batch != batch {
                return Ok(photons);
            }
            photons.extend(&mut self.photons);
        }
    }

    /// Reads the next block; false at the end.
    fn read(&mut self) -> anyhow::Result<bool> {
        let next = self.reader.next_block().with_context(|| self.name.clone())?;
        let Some((meta, photons)) = next else { return Ok(false) };
        let damaged = |what: &str| pm_exchange::bad_input(format!("{}: batch {}: {what}", self.name, meta.batch));
        if !self.part.has(meta.batch) {
            return Err(damaged("another part has it"));
        }
        if meta.batch < self.batch {
            return Err(damaged("the batches are out of order"));
        }
        let paths = photons.iter().map(|photon| u64::from(photon.path));
        if !paths.clone().is_sorted() || paths.max().is_some_and(|last| last >= PATHS) {
            return Err(damaged("its paths are out of order"));
        }
        (self.batch, self.photons) = (meta.batch, photons.into_iter().peekable());
        Ok(true)
    }

    /// Paths that the part holds.
    fn traced(&self) -> anyhow::Result<u64> {
        match self.reader.end()?.measure(measure::PATHS_TRACED) {
            Some(Number::Count(paths)) => Ok(paths),
            _ => {
                Err(pm_exchange::bad_input(format!("{}: its end block does not say how many paths it has", self.name)))
            }
        }
    }

    /// Reads what is left, which must be whole.
    fn finish(&mut self) -> anyhow::Result<()> {
        while self.read()? {}
        self.traced().map(|_| ())
    }
}
