//! Accesses that were read, as they can be compared.

use crate::traces::{Opened, Reading, Trace, TraceImport, open};
use pm_formats::trace::{Access, AccessKind, TraceSink};
use pm_registry::Registry;
use std::io::Cursor;

/// Kind, address and length of an access.
pub(super) type Seen = (AccessKind, u64, u32);

struct Heard<'a> {
    trace: &'a [u64],
    accesses: Vec<Seen>,
}

impl TraceSink for Heard<'_> {
    fn access(&mut self, access: Access) {
        self.accesses.push((access.kind, self.trace[usize::from(access.region)] + access.offset, access.len));
    }
}

/// The trace in an input, read to its end of a foreign format, or what is wrong with it.
pub(super) fn trace_in(input: &[u8], reading: &Reading, imports: &Registry<dyn TraceImport>) -> Result<Trace, String> {
    let mut trace = begun_in(input, reading, imports)?;
    struct Deaf;
    impl TraceSink for Deaf {
        fn access(&mut self, _: Access) {}
    }
    trace.replay(&mut Deaf).map_err(|error| format!("{error:#}"))?;
    Ok(trace)
}

/// The trace in an input, of which only the beginning was read.
fn begun_in(input: &[u8], reading: &Reading, imports: &Registry<dyn TraceImport>) -> Result<Trace, String> {
    match open(Cursor::new(input.to_vec()), reading, imports) {
        Ok(Opened::Foreign(trace)) => Ok(trace),
        Ok(Opened::Ours(_)) => Err("taken for a stream of ours".into()),
        Err(error) => Err(format!("{error:#}")),
    }
}

/// The word of an input's format, and its accesses.
pub(super) fn accesses_in(
    input: &[u8],
    reading: &Reading,
    imports: &Registry<dyn TraceImport>,
) -> Result<(&'static str, Vec<Seen>), String> {
    let mut trace = begun_in(input, reading, imports)?;
    let bases: Vec<u64> = trace.regions().iter().map(|region| region.base).collect();
    let mut heard = Heard { trace: &bases, accesses: vec![] };
    trace.replay(&mut heard).map_err(|error| format!("{error:#}"))?;
    Ok((trace.format().word(), heard.accesses))
}
