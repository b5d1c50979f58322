//! What is searched: photons, and windows of queries.

use anyhow::Context as _;
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{Block, BlockReader, Header, Number, Photon, Query, RecordReader, Tally, decode_records};
use std::fs::File;
use std::io::BufReader;

/// A photon map's photons.
pub(crate) struct Photons {
    pub(crate) records: Vec<Photon>,
    pub(crate) emitted_paths: u64,
}

impl Photons {
    /// Reads all of a stream.
    pub(crate) fn read(path: &str) -> anyhow::Result<Self> {
        let mut reader = RecordReader::<Photon, _>::new(open(path)?)?;
        let mut records = vec![];
        while let Some((_, mut more)) = reader.next_block()? {
            records.append(&mut more);
        }
        match reader.end()?.measure(measure::EMITTED_PATHS) {
            Some(Number::Count(emitted_paths)) => Ok(Self { records, emitted_paths }),
            _ => anyhow::bail!("{path}: how many paths were emitted?"),
        }
    }
}

/// Windows of a stream of queries, each from the middle of a chain of searches.
pub(crate) struct Queries {
    pub(crate) header: Header,
    /// In which order they come.
    pub(crate) order: String,
    /// How many the stream had of which these are windows.
    pub(crate) of: u64,
    pub(crate) blocks: Vec<Block>,
    /// Where is searched, window by window.
    pub(crate) points: Vec<Vec<[f32; 3]>>,
}

impl Queries {
    /// Reads all of a stream.
    pub(crate) fn read(path: &str) -> anyhow::Result<Self> {
        let mut reader = BlockReader::new(open(path)?)?;
        let header = reader.header().clone();
        let (mut blocks, mut points, mut tally) = (vec![], vec![], Tally::default());
        while let Some(block) = reader.next_block()? {
            let (queries, more) = decode_records::<Query>(&block).context("queries")?;
            tally += more;
            // A window is whole without what warms caches up.
            if block.meta.warm_up {
                continue;
            }
            points.push(queries.iter().map(|query| query.position).collect());
            blocks.push(block);
        }
        let of = match reader.end(tally)?.measure(measure::QUERIES_GIVEN) {
            Some(Number::Count(given)) => given,
            _ => anyhow::bail!("{path}: of how many queries is this a sample?"),
        };
        let order = [meaning::DEFERRED_ORDER, meaning::ORDER].iter().find_map(|name| header.meaning(name));
        let order = order.map_or_else(String::new, ToString::to_string);
        Ok(Self { header, order, of, blocks, points })
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.points.iter().map(Vec::len).sum()
    }
}

fn open(path: &str) -> anyhow::Result<BufReader<File>> {
    Ok(BufReader::new(File::open(path).with_context(|| path.to_owned())?))
}
