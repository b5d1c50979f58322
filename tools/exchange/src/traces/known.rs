//! What the first bytes of an input show, whatever it is said to be.

use super::TraceImport;
use super::recognise::signed;
use super::unpack::Packing;
use pm_formats::MAGIC;
use pm_registry::Registry;

/// What an input is known to be.
pub(super) enum Known {
    /// A stream of ours.
    Ours,
    /// A trace in this format.
    Trace(&'static dyn TraceImport),
    /// Something that is not read: what it is, and what to do.
    Other(&'static str),
}

/// Signatures of what may be given for a trace and is not read, and what to say.
const OTHERS: &[(&[u8], &str)] = &[
    (b"\x04\x22\x4d\x18", "compressed by lz4; unpack it with lz4 -d"),
    (b"\xff\x06\0\0sNaPpY", "compressed by snappy; unpack it, or record it compressed by gzip"),
    (b"7z\xbc\xaf\x27\x1c", "an archive of 7-Zip; unpack it with 7z x"),
    (b"PAR1", "a table in Parquet; write it as CSV"),
    (b"ARROW1", "a table in Arrow; write it as CSV"),
    (b"Obj\x01", "a table in Avro; write it as CSV"),
    (b"\x93NUMPY", "an array of NumPy; write it with array.astype('<u8').tofile(file) and read it as raw64"),
    (b"\x89HDF\r\n\x1a\n", "a file of HDF5; write its addresses as CSV"),
    (b"SQLite format 3\0", "a database of SQLite; write its addresses as CSV"),
    (b"PERFILE2", "what perf recorded; print it with perf script -F addr and read it as CSV"),
    (b"gem5", "packets of gem5 in protobuf; print them with gem5's util/decode_packet_trace.py"),
    (b"SIFT", "instructions of Sniper, which are not read"),
    (b"\x7fELF", "a program and not its trace"),
];

/// What an input that begins so is known to be.
pub(super) fn known(beginning: &[u8], imports: &Registry<dyn TraceImport>) -> Option<Known> {
    if beginning.starts_with(&MAGIC) {
        return Some(Known::Ours);
    }
    if let Some(format) = signed(beginning, imports) {
        return Some(Known::Trace(format));
    }
    if Packing::of(beginning).is_some() {
        return Some(Known::Other("compressed twice; unpack it once"));
    }
    OTHERS.iter().find(|(signature, _)| beginning.starts_with(signature)).map(|(_, what)| Known::Other(what))
}

/// Bytes that are looked at.
const LOOKED_AT: usize = 1 << 12;
/// Fewer bytes than this may be letters by chance.
const FEWEST: usize = 12;

/// Is an input that begins so a text, lines of printable letters? Binary records are none: some of their bytes are 0, or
/// at least no letters.
pub(super) fn is_text(beginning: &[u8]) -> bool {
    let beginning = &beginning[..beginning.len().min(LOOKED_AT)];
    let letter = |byte: &u8| byte.is_ascii_graphic() || b" \t\r\n".contains(byte);
    beginning.len() >= FEWEST && beginning.contains(&b'\n') && beginning.iter().all(letter)
}
