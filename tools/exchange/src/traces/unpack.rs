//! Inputs compressed by gzip, zstd, xz or bzip2, and zip archives, known by their first bytes.

mod archive;

use crate::fault::BadInput;
use archive::Archive;
use bzip2::bufread::MultiBzDecoder;
use flate2::bufread::MultiGzDecoder;
use lzma_rust2::XzReader;
use std::cell::Cell;
use std::io::{self, BufRead, BufReader, Cursor, Read};
use std::rc::Rc;

/// An input, whatever lies between it and the file.
pub(super) type Bytes = Box<dyn BufRead>;

/// RFC 1952, section 2.3.1, with the only method there is.
const GZIP: &[u8] = b"\x1f\x8b\x08";
/// RFC 8878, section 3.1.1.
const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";
/// RFC 8878, section 3.1.2: after any byte 5X. Parallel compressors begin with such a frame.
const SKIPPABLE: &[u8] = b"\x2a\x4d\x18";
/// The .xz File Format, section 2.1.1.1.
const XZ: &[u8] = b"\xfd7zXZ\0";
/// Of a bzip2 file, before the digit that tells the size of its blocks.
const BZIP2: &[u8] = b"BZh";
/// What follows that digit: a block, or the end of an empty file.
const BZIP2_BLOCKS: [&[u8]; 2] = [b"\x31\x41\x59\x26\x53\x59", b"\x17\x72\x45\x38\x50\x90"];
/// APPNOTE.TXT, section 4.3.7: a file of a zip archive.
const ZIP: &[u8] = b"PK\x03\x04";

/// How far back zstd frames may reach, log2 of bytes: the farthest that zstd writes (`--long=31`). So much memory is needed
/// then; xz files may ask for as much.
const FARTHEST: u32 = 31;

/// The first bytes, fewer if there are no more, and the input with them.
pub(super) fn peek(mut input: Bytes, bytes: usize) -> io::Result<(Vec<u8>, Bytes)> {
    let mut head = vec![];
    (&mut input).take(bytes as u64).read_to_end(&mut head)?;
    Ok((head.clone(), Box::new(Cursor::new(head).chain(input))))
}

/// How an input that begins so is compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    Gzip,
    Zstd,
    Xz,
    Bzip2,
    Zip,
}

impl Packing {
    /// How an input that begins so is compressed, if it is.
    pub(super) fn of(head: &[u8]) -> Option<Self> {
        let bzip2 = || {
            head.starts_with(BZIP2)
                && head.get(3).is_some_and(|size| (b'1'..=b'9').contains(size))
                && BZIP2_BLOCKS.iter().any(|block| head[4..].starts_with(block))
        };
        if head.starts_with(GZIP) {
            Some(Self::Gzip)
        } else if head.starts_with(ZSTD) || (head.len() >= 4 && head[0] >> 4 == 5 && head[1..4] == *SKIPPABLE) {
            Some(Self::Zstd)
        } else if head.starts_with(XZ) {
            Some(Self::Xz)
        } else if bzip2() {
            Some(Self::Bzip2)
        } else if head.starts_with(ZIP) {
            Some(Self::Zip)
        } else {
            None
        }
    }

    /// Its name.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Gzip => "gzip",
            Self::Zstd => "zstd",
            Self::Xz => "xz",
            Self::Bzip2 => "bzip2",
            Self::Zip => "zip",
        }
    }
}

/// Bytes by which a packing is known.
const HEAD: usize = 10;

/// The input, decompressed if it is compressed. Frames may follow one another; anything else after one is an error.
///
/// # Errors
/// If an archive holds no trace; what the input reports.
pub(super) fn unpack(input: Bytes) -> anyhow::Result<Bytes> {
    let (head, input) = peek(input, HEAD)?;
    let Some(packing) = Packing::of(&head) else { return Ok(input) };
    let failed = Rc::new(Cell::new(false));
    let watched = Watched { input, failed: Rc::clone(&failed) };
    let decoder: Box<dyn Read> = match packing {
        Packing::Gzip => Box::new(MultiGzDecoder::new(watched)),
        Packing::Zstd => {
            let mut decoder = zstd::stream::read::Decoder::with_buffer(watched)?;
            decoder.window_log_max(FARTHEST)?;
            Box::new(decoder)
        }
        Packing::Xz => Box::new(XzReader::new_mem_limit(watched, true, 1 << (FARTHEST - 10))),
        Packing::Bzip2 => Box::new(MultiBzDecoder::new(watched)),
        Packing::Zip => Box::new(Archive::open(watched)?),
    };
    Ok(Box::new(BufReader::with_capacity(1 << 17, Checked { decoder, packing, failed })))
}

/// Notes whether the file itself could not be read, to tell that from compressed data that are damaged.
struct Watched {
    input: Bytes,
    failed: Rc<Cell<bool>>,
}

impl Watched {
    fn note<T>(failed: &Cell<bool>, outcome: io::Result<T>) -> io::Result<T> {
        if outcome.as_ref().is_err_and(|error| error.kind() != io::ErrorKind::Interrupted) {
            failed.set(true);
        }
        outcome
    }
}

impl Read for Watched {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        Self::note(&self.failed, self.input.read(buffer))
    }
}

impl BufRead for Watched {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        Self::note(&self.failed, self.input.fill_buf())
    }

    fn consume(&mut self, bytes: usize) {
        self.input.consume(bytes);
    }
}

/// Says of a decoder's errors that the input is at fault.
struct Checked {
    decoder: Box<dyn Read>,
    packing: Packing,
    failed: Rc<Cell<bool>>,
}

impl Read for Checked {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.decoder.read(buffer).map_err(|error| {
            if self.failed.get() || error.kind() == io::ErrorKind::Interrupted {
                return error;
            }
            let text = format!(
                "the compressed input ({}) is damaged, cut, followed by something else, or needs more than 2 GiB: {error}",
                self.packing.name()
            );
            io::Error::new(io::ErrorKind::InvalidData, BadInput::new(text))
        })
    }
}
