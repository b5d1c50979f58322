//! Counts the searches and accesses of a trace: `cargo run --example count_accesses trace.pmt`.

use pm_formats::trace::{Access, AccessKind, TraceReader, TraceSink};
use std::fs::File;
use std::io::{BufReader, Read, Write as _};

/// What a trace holds.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Searches.
    pub(crate) searches: u64,
    /// Accesses that all of them made.
    pub(crate) accesses: u64,
    /// Those of them that write.
    pub(crate) writes: u64,
    /// Bytes that were read or written.
    pub(crate) bytes: u64,
}

/// A trace is told to whoever listens, access by access.
impl TraceSink for Counts {
    fn search(&mut self, _destinations: &[u32]) {
        self.searches += 1;
    }

    fn access(&mut self, access: Access) {
        self.accesses += 1;
        self.writes += u64::from(access.kind != AccessKind::Read);
        self.bytes += u64::from(access.len);
    }
}

/// Counts what is in a trace; one that is cut or damaged is an error, not a smaller count.
///
/// # Errors
/// If it is no trace, or not whole.
pub(crate) fn count(trace: impl Read) -> pm_formats::Result<Counts> {
    let mut trace = TraceReader::new(trace)?;
    let mut counts = Counts::default();
    while trace.replay_block(&mut counts)?.is_some() {}
    Ok(counts)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("name a trace, such as trace.pmt")?;
    let counts = count(BufReader::new(File::open(path)?))?;
    Ok(writeln!(std::io::stdout(), "{counts:?}")?)
}
