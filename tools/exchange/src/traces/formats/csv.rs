//! Lines of addresses, with or without sizes and kinds, between commas, semicolons or tabs.
//!
//! A first line with a column `address` names the columns (`address`, `size`, `kind`; others are passed over). Without
//! one they are these three, or those given. What is asked for as `key` instead of an address is a text of any kind. Numbers are
//! decimal, or hexadecimal with `0x`; lines that begin with `#` are comments, but the first one may name the columns.

mod columns;

use crate::traces::text::{number, quoted, size};
use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, Example, Kinds, Parsed, ParserOfColumns, Piece, PieceWriter,
    Reference, TraceExport, TraceImport, Unwritten,
};
use columns::Columns;
use pm_formats::Digest;
use pm_formats::trace::AccessKind;
use std::io::{self, Write};

pm_registry::registered! {
    /// Columns address, size, kind: by the names of the first line, or in this order
    pub struct Csv = "csv";
}

/// Knows where the columns are, at the latest from the first line on.
struct Parser {
    columns: Columns,
}

impl EntryParser for Parser {
    fn parse(&mut self, line: &[u8]) -> Parsed {
        let text = line.trim_ascii();
        let comment = text.strip_prefix(b"#");
        if text.is_empty() || (comment.is_some() && self.columns.found().is_some()) {
            return Ok(None);
        }
        let fields: Vec<Vec<u8>> = comment.unwrap_or(text).split(|byte| b",;\t".contains(byte)).map(unquoted).collect();
        let places = match self.columns.found() {
            Some(places) => places,
            None => match self.columns.find(&fields, comment.is_some())? {
                Some(places) => places,
                None => return Ok(None),
            },
        };
        let field = |column: usize| fields.get(column).filter(|field| !field.is_empty());
        let address = field(places.address).ok_or_else(|| format!("{} has no address", quoted(line)))?;
        let address = if places.keys { address_of_key(address) } else { number(address)? };
        let len = places.size.and_then(field).map(|field| size(number(field)?)).transpose()?;
        let kind = places.kind.and_then(field).map_or(Ok(EntryKind::READ), |field| kind(field))?;
        self.columns.settle(places);
        Ok(Some(Reference { kind, address, len }))
    }
}

/// Where an object lies that is known by a text: where its hash says (the low half of XXH3-128), at the beginning of a page of
/// 4 KiB, so that it spans no more lines than its bytes need, and below 2^63, so that it does not reach beyond the last
/// address. Of a million objects two share a page once in 5,000 traces.
fn address_of_key(key: &[u8]) -> u64 {
    (Digest::of(key).0 as u64 >> 1) & !0xfff
}

fn unquoted(field: &[u8]) -> Vec<u8> {
    let field = field.trim_ascii();
    let inner = field.strip_prefix(b"\"").and_then(|field| field.strip_suffix(b"\""));
    inner.unwrap_or(field).to_vec()
}

fn kind(field: &[u8]) -> Result<EntryKind, String> {
    match &*field.to_ascii_lowercase() {
        b"r" | b"read" | b"l" | b"ld" | b"load" | b"get" => Ok(EntryKind::READ),
        b"w" | b"write" | b"s" | b"st" | b"store" | b"set" => Ok(EntryKind::WRITE),
        b"m" | b"rmw" | b"modify" => Ok(EntryKind::MODIFY),
        b"i" | b"instruction" => Ok(EntryKind::Instruction),
        _ => Err(format!("kind {} is none of read, write, rmw, instruction", quoted(field))),
    }
}

impl TraceImport for Csv {
    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize::BYTE)
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(Parser { columns: Columns::unknown() })
    }

    fn parser_of_columns(&self) -> Option<ParserOfColumns> {
        Some(|names| Ok(Box::new(Parser { columns: Columns::asked(names)? })))
    }

    fn example(&self) -> Example {
        Example {
            input: b"17,4,w\n0x11;8;rmw\n18\t2\tLoad\n19,,\n64,4,i\n",
            entries: &[
                Reference { kind: EntryKind::WRITE, address: 17, len: Some(4) },
                Reference { kind: EntryKind::MODIFY, address: 17, len: Some(8) },
                Reference { kind: EntryKind::READ, address: 18, len: Some(2) },
                Reference { kind: EntryKind::READ, address: 19, len: None },
                Reference { kind: EntryKind::Instruction, address: 64, len: Some(4) },
            ],
        }
    }
}

struct Writer;

impl PieceWriter for Writer {
    fn begin(&mut self, output: &mut dyn Write) -> io::Result<()> {
        output.write_all(b"address,size,kind\n")
    }

    fn write(&mut self, piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
        let kind = match piece.kind {
            AccessKind::Read => "read",
            AccessKind::Write => "write",
            AccessKind::ReadModifyWrite => "rmw",
        };
        Ok(writeln!(output, "{:#x},{},{kind}", piece.address, piece.len)?)
    }
}

impl TraceExport for Csv {
    fn is_text(&self) -> bool {
        true
    }

    fn carried(&self) -> Carried {
        Carried { sizes: true, kinds: Kinds::All }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(Writer))
    }
}
