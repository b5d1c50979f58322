//! A zip archive as an input: its only file, or the parts of a trace of drmemtrace, one after another.
//!
//! The directory of an archive stands at its end, so it waits in a temporary file.

use crate::fault::bad_input;
use anyhow::Context as _;
use flate2::Crc;
use flate2::read::DeflateDecoder;
use std::fs::File;
use std::io::{self, Read, Seek as _, SeekFrom, Take};
use std::sync::Arc;
use zip::{CompressionMethod, ZipArchive};

/// How the names of the parts begin that drmemtrace writes (`TRACE_CHUNK_PREFIX`, `chunk.0000`).
const PART: &str = "chunk.";

/// Where a file of the archive lies.
struct Part {
    begin: u64,
    compressed: u64,
    deflated: bool,
    checksum: u32,
}

/// Reads the parts.
pub(super) struct Archive {
    file: Arc<File>,
    parts: std::vec::IntoIter<Part>,
    current: Option<Current>,
}

/// A part that is being read.
struct Current {
    data: Box<dyn Read>,
    found: Crc,
    checksum: u32,
}

impl Archive {
    /// The archive in `input`.
    ///
    /// # Errors
    /// If it is damaged, or holds something else; what `input` and the temporary file report.
    pub(super) fn open(mut input: impl Read) -> anyhow::Result<Self> {
        let mut file = tempfile::tempfile().context("temporary file")?;
        io::copy(&mut input, &mut file)?;
        let damaged =
            |error: zip::result::ZipError| bad_input(format!("the compressed input (zip) is damaged: {error}"));
        let mut archive = ZipArchive::new(file.try_clone()?).map_err(damaged)?;
        let (mut parts, mut names) = (vec![], vec![]);
        for number in 0..archive.len() {
            let entry = archive.by_index_raw(number).map_err(damaged)?;
            if entry.is_dir() {
                continue;
            }
            let deflated = match entry.compression() {
                CompressionMethod::Stored => false,
                CompressionMethod::Deflated => true,
                other => return Err(bad_input(format!("the zip archive is compressed by {other}: unpack it"))),
            };
            if entry.encrypted() {
                return Err(bad_input("the zip archive is encrypted: unpack it"));
            }
            names.push(entry.name().to_owned());
            let begin = entry.data_start().ok_or_else(|| bad_input("the compressed input (zip) is damaged"))?;
            parts.push(Part { begin, compressed: entry.compressed_size(), deflated, checksum: entry.crc32() });
        }
        if parts.len() != 1 && !(parts.len() > 1 && names.iter().all(|name| name.starts_with(PART))) {
            let number = parts.len();
            return Err(bad_input(format!("the zip archive holds {number} files: unpack it and give one of them")));
        }
        Ok(Self { file: Arc::new(file), parts: parts.into_iter(), current: None })
    }

    /// The next part, if there is one.
    fn next(&mut self) -> io::Result<bool> {
        let Some(part) = self.parts.next() else { return Ok(false) };
        let mut file = Arc::clone(&self.file);
        file.seek(SeekFrom::Start(part.begin))?;
        let stored: Take<Arc<File>> = file.take(part.compressed);
        let data: Box<dyn Read> = if part.deflated { Box::new(DeflateDecoder::new(stored)) } else { Box::new(stored) };
        self.current = Some(Current { data, found: Crc::new(), checksum: part.checksum });
        Ok(true)
    }
}

impl Read for Archive {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if buffer.is_empty() {
            return Ok(0);
        }
        loop {
            if let Some(current) = &mut self.current {
                let got = current.data.read(buffer)?;
                if got > 0 {
                    current.found.update(&buffer[..got]);
                    return Ok(got);
                }
                if current.found.sum() != current.checksum {
                    return Err(io::Error::new(io::ErrorKind::InvalidData, "a checksum is wrong"));
                }
                self.current = None;
            }
            if !self.next()? {
                return Ok(0);
            }
        }
    }
}
