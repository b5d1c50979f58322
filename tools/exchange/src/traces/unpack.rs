//! Inputs compressed by gzip or zstd, known by their first bytes.

use crate::fault::BadInput;
use flate2::bufread::MultiGzDecoder;
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

/// The first bytes, fewer if there are no more, and the input with them.
pub(super) fn peek(mut input: Bytes, bytes: usize) -> io::Result<(Vec<u8>, Bytes)> {
    let mut head = vec![];
    (&mut input).take(bytes as u64).read_to_end(&mut head)?;
    Ok((head.clone(), Box::new(Cursor::new(head).chain(input))))
}

/// The input, decompressed if it is compressed. Frames may follow one another; anything else after one is an error.
pub(super) fn unpack(input: Bytes) -> io::Result<Bytes> {
    let (head, input) = peek(input, 4)?;
    let failed = Rc::new(Cell::new(false));
    let watched = Watched { input, failed: Rc::clone(&failed) };
    let checked = |decoder: Box<dyn Read>, name| -> Bytes {
        Box::new(BufReader::with_capacity(1 << 17, Checked { decoder, name, failed }))
    };
    if head.starts_with(GZIP) {
        Ok(checked(Box::new(MultiGzDecoder::new(watched)), "gzip"))
    } else if head.starts_with(ZSTD) || (head.len() == 4 && head[0] >> 4 == 5 && head[1..] == *SKIPPABLE) {
        Ok(checked(Box::new(zstd::stream::read::Decoder::with_buffer(watched)?), "zstd"))
    } else {
        Ok(watched.input)
    }
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
    name: &'static str,
    failed: Rc<Cell<bool>>,
}

impl Read for Checked {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.decoder.read(buffer).map_err(|error| {
            if self.failed.get() || error.kind() == io::ErrorKind::Interrupted {
                return error;
            }
            let text =
                format!("the compressed input ({}) is damaged, cut or followed by something else: {error}", self.name);
            io::Error::new(io::ErrorKind::InvalidData, BadInput::new(text))
        })
    }
}
