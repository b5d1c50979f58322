//! Input streams: a file, or standard input by `-`.

use super::claims;
use super::memory::is_room_for_work;
use super::usage::usage;
use anyhow::{Context as _, bail};
use pm_exchange::BadInput;
use pm_formats::{BlockReader, End, Header, Record, RecordReader, Tally};
use std::fs::File;
use std::io::{self, BufRead, BufReader, IsTerminal as _, Read};
use std::os::fd::AsFd as _;
use std::path::Path;

/// An input stream that names itself in its errors.
pub struct Input {
    name: String,
    file: Source,
}

/// Where the bytes come from.
enum Source {
    Plain(BufReader<File>),
    /// A file that was compressed as a whole.
    Zstd(BufReader<zstd::stream::read::Decoder<'static, BufReader<File>>>),
}

/// RFC 8878, section 3.1.1: how a zstd frame begins.
const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";

/// What is said when a file cannot be read.
fn unread(error: io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("cannot read: {error}"))
}

/// What is said when what it holds cannot be decompressed.
fn damaged(error: io::Error) -> io::Error {
    let text = format!("the compressed input (zstd) is damaged or cut: {error}");
    io::Error::new(io::ErrorKind::InvalidData, BadInput::new(text))
}

impl Read for Input {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match &mut self.file {
            Source::Plain(file) => file.read(buffer).map_err(unread),
            Source::Zstd(file) => file.read(buffer).map_err(damaged),
        }
    }
}

impl BufRead for Input {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        match &mut self.file {
            Source::Plain(file) => file.fill_buf().map_err(unread),
            Source::Zstd(file) => file.fill_buf().map_err(damaged),
        }
    }

    fn consume(&mut self, bytes: usize) {
        match &mut self.file {
            Source::Plain(file) => file.consume(bytes),
            Source::Zstd(file) => file.consume(bytes),
        }
    }
}

impl Input {
    /// The same, decompressed if it is compressed by zstd.
    fn decompressed(self) -> io::Result<Self> {
        let Self { name, file: Source::Plain(mut file) } = self else { return Ok(self) };
        let file = if file.fill_buf().map_err(unread)?.starts_with(ZSTD) {
            let decoder = zstd::stream::read::Decoder::with_buffer(file)?;
            Source::Zstd(BufReader::with_capacity(CAPACITY, decoder))
        } else {
            Source::Plain(file)
        };
        Ok(Self { name, file })
    }
}

/// Bytes read at once.
const CAPACITY: usize = 1 << 18;

/// How an input is called in messages.
#[must_use]
pub fn named(path: &Path) -> String {
    if path == Path::new("-") { "standard input".into() } else { path.display().to_string() }
}

/// Opens a stream and reads its header.
///
/// # Errors
/// If there is no such file, if a terminal would have to type the stream, or if the header is not one of ours.
pub fn open_input(path: &Path) -> anyhow::Result<BlockReader<Input>> {
    let input = open_bytes(path)?.decompressed().with_context(|| named(path))?;
    BlockReader::new(input).with_context(|| named(path))
}

/// Opens an input, whatever it holds.
///
/// # Errors
/// If there is no such file, or if a terminal would have to type it.
pub fn open_bytes(path: &Path) -> anyhow::Result<Input> {
    let name = named(path);
    let file = if path == Path::new("-") {
        let stdin = io::stdin();
        if stdin.is_terminal() {
            return Err(usage("a stream is expected on standard input; pipe one in or name a file (see --help)"));
        }
        // Past std's own buffer: blocks are large, and whoever shares the descriptor finds what was not read.
        File::from(stdin.as_fd().try_clone_to_owned().context("standard input")?)
    } else {
        claims::read(path)?;
        File::open(path).with_context(|| name.clone())?
    };
    if file.metadata().is_ok_and(|metadata| metadata.is_dir()) {
        return Err(usage(format!("{name} is a folder; a stream is expected")));
    }
    Ok(Input { name, file: Source::Plain(BufReader::with_capacity(CAPACITY, file)) })
}

/// A stream of records that was read to its end.
pub struct Whole<T> {
    /// Its header.
    pub header: Header,
    /// All its records, in order.
    pub records: Vec<T>,
    /// Its end block.
    pub end: End,
    /// Number and digest of the records.
    pub tally: Tally,
}

/// Reads a stream of records into memory.
///
/// # Errors
/// If it cannot be opened or read, holds other records, or is incomplete or damaged.
pub fn read_whole<T: Record>(path: &Path) -> anyhow::Result<Whole<T>> {
    let mut input = RecordReader::<T, _>::from_blocks(open_input(path)?).with_context(|| named(path))?;
    let mut records = vec![];
    while let Some((_, block)) = input.next_block().with_context(|| named(path))? {
        let grows = records.capacity() - records.len() < block.len();
        if grows && (records.try_reserve(block.len()).is_err() || !is_room_for_work()) {
            bail!("{}: not enough memory for more than its first {} records", named(path), records.len());
        }
        records.extend(block);
    }
    let end = input.end()?.clone();
    Ok(Whole { header: input.header().clone(), records, end, tally: input.tally() })
}

impl Input {
    /// How the input is called in messages.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
}
