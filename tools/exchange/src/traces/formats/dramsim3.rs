//! `dramsim3`: transactions for the simulator of memories of that name, such as `0x1000 READ 7`; the address is hexadecimal
//! with or without `0x`.
//!
//! That simulator (`src/cpu.cc`, `TraceBasedCPU::ClockTick`) looks for the end of the file before it reads a line, not after:
//! if the last line has a line end, it issues the transaction twice, where its queue has room at once; if it has none, not at
//! all, where its queue has no room at once. So what is written ends with a transaction in a cycle that never comes, without a
//! line end: all before it are issued once. Read, such a transaction is none.

use crate::traces::text::{hexadecimal, number, quoted, words};
use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, Example, Kinds, Parsed, Piece, PieceWriter, Reference, TraceExport,
    TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// DRAMsim3: address, READ or WRITE, cycle, such as 0x1000 READ 7
    pub struct Dramsim3 = "dramsim3";
}

fn parse(line: &[u8]) -> Parsed {
    let wrong = || format!("{} is not an address, READ or WRITE, and a cycle", quoted(line));
    let [address, kind, cycle] = words(line).collect::<Vec<_>>()[..] else { return Err(wrong()) };
    let kind = match kind {
        b"READ" | b"read" | b"P_MEM_RD" => EntryKind::READ,
        b"WRITE" | b"write" | b"P_MEM_WR" => EntryKind::WRITE,
        _ => return Err(wrong()),
    };
    let address = hexadecimal(address)?;
    Ok((number(cycle)? != NEVER).then_some(Reference { kind, address, len: None }))
}

/// A cycle that never comes, in 63 bits.
const NEVER: u64 = i64::MAX.cast_unsigned();

impl TraceImport for Dramsim3 {
    fn assumed_size(&self) -> Option<AssumedSize> {
        // What a memory transfers at once.
        Some(AssumedSize::bytes(64))
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"0x1000 READ 0\n40 WRITE 17\n0x0 READ 9223372036854775807",
            entries: &[
                Reference { kind: EntryKind::READ, address: 4096, len: None },
                Reference { kind: EntryKind::WRITE, address: 64, len: None },
            ],
        }
    }
}

/// There is no clock in a trace of ours: the cycle is the number of the transaction.
struct Writer {
    transactions: u64,
}

impl PieceWriter for Writer {
    fn write(&mut self, piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
        let kind = if piece.is_write() { "WRITE" } else { "READ" };
        writeln!(output, "{:#x} {kind} {}", piece.address, self.transactions)?;
        self.transactions += 1;
        Ok(())
    }

    fn finish(&mut self, output: &mut dyn Write) -> io::Result<()> {
        if self.transactions > 0 {
            write!(output, "0x0 READ {NEVER}")?;
        }
        Ok(())
    }
}

impl TraceExport for Dramsim3 {
    fn is_text(&self) -> bool {
        true
    }

    fn carried(&self) -> Carried {
        Carried { sizes: false, kinds: Kinds::ReadsAndWrites }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(Writer { transactions: 0 }))
    }
}

#[cfg(test)]
mod tests;
