//! The entries of an input, one after another: lines of text, or records of a fixed length.

use super::csv::Csv;
use super::{Form, Parsed, Reference, din, dinb, dram, lackey, numbers, oracle_general, raw};
use crate::fault::bad_input;
use std::io::{BufRead, ErrorKind, Read as _};

/// Longest line, in bytes: a file without line ends is no text.
pub(super) const LONGEST_LINE: u64 = 1 << 16;

/// What understands an entry.
pub(super) enum Parser {
    Line(fn(&[u8]) -> Parsed),
    Csv(Csv),
    Record(usize, fn(&[u8]) -> Parsed),
}

impl Parser {
    /// The parser of a form; `columns` are for `csv`.
    ///
    /// # Errors
    /// Usage, if the columns make no sense or the form has none.
    pub(super) fn new(form: Form, columns: Option<&[String]>) -> anyhow::Result<Self> {
        Ok(match form {
            Form::Csv => Self::Csv(Csv::new(columns)?),
            Form::Raw32 => Self::Record(4, raw::parse_32),
            Form::Raw64 => Self::Record(8, raw::parse_64),
            Form::Dinb => Self::Record(dinb::BYTES, dinb::parse),
            Form::OracleGeneral => Self::Record(oracle_general::BYTES, oracle_general::parse),
            Form::Din => Self::Line(din::parse_din),
            Form::Xdin => Self::Line(din::parse_xdin),
            Form::Lackey => Self::Line(lackey::parse),
            Form::Dramsim3 => Self::Line(dram::parse_dramsim3),
            Form::Ramulator2 => Self::Line(dram::parse_ramulator2),
        })
    }

    pub(super) fn parse(&mut self, entry: &[u8]) -> Parsed {
        match self {
            Self::Line(parse) | Self::Record(_, parse) => parse(entry),
            Self::Csv(csv) => csv.parse(entry),
        }
    }
}

/// Reads entries and knows which it is at.
pub(super) struct Entries<R> {
    input: R,
    parser: Parser,
    entry: Vec<u8>,
    /// Lines or records read.
    number: u64,
}

impl<R: BufRead> Entries<R> {
    pub(super) fn new(input: R, parser: Parser) -> Self {
        Self { input, parser, entry: vec![], number: 0 }
    }

    /// The next entry that is no comment.
    ///
    /// # Errors
    /// With its number, if it is not of the format; what the input reports.
    pub(super) fn next_reference(&mut self) -> anyhow::Result<Option<Reference>> {
        loop {
            let there = match self.parser {
                Parser::Record(bytes, _) => self.record(bytes)?,
                _ => self.line()?,
            };
            if !there {
                return Ok(None);
            }
            match self.parser.parse(&self.entry) {
                Ok(Some(reference)) => return Ok(Some(reference)),
                Ok(None) => {}
                Err(what) => return Err(self.wrong(&what)),
            }
        }
    }

    /// The error that something about the entry read last is wrong.
    pub(super) fn wrong(&self, what: &str) -> anyhow::Error {
        let unit = if matches!(self.parser, Parser::Record(..)) { "record" } else { "line" };
        bad_input(format!("{unit} {}: {what}", self.number))
    }

    fn line(&mut self) -> anyhow::Result<bool> {
        self.entry.clear();
        (&mut self.input).take(LONGEST_LINE).read_until(b'\n', &mut self.entry)?;
        if self.entry.is_empty() {
            return Ok(false);
        }
        self.number += 1;
        if self.entry.pop_if(|byte| *byte == b'\n').is_none() && self.entry.len() as u64 == LONGEST_LINE {
            return Err(self.wrong("longer than 65536 bytes: this is no text"));
        }
        if self.entry.contains(&0) {
            return Err(self.wrong(&format!("{} is no text", numbers::quoted(&self.entry))));
        }
        Ok(true)
    }

    fn record(&mut self, bytes: usize) -> anyhow::Result<bool> {
        self.entry.resize(bytes, 0);
        let mut got = 0;
        while got < bytes {
            match self.input.read(&mut self.entry[got..]) {
                Ok(0) => break,
                Ok(n) => got += n,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        }
        if got == 0 {
            return Ok(false);
        }
        self.number += 1;
        if got < bytes {
            return Err(self.wrong(&format!("the input ends after {got} of its {bytes} bytes")));
        }
        Ok(true)
    }
}

/// Whether the beginning of an input is that of a form: its first line that is no comment is one of the form's.
pub(super) fn begins_as(form: Form, beginning: &[u8]) -> bool {
    let Ok(mut parser) = Parser::new(form, None) else { return false };
    let mut comments = false;
    for line in beginning.split(|&byte| byte == b'\n') {
        if line.iter().any(|&byte| byte.is_ascii_control() && !b"\t\r".contains(&byte)) {
            return false;
        }
        match parser.parse(line) {
            Ok(Some(_)) => return true,
            Ok(None) => comments |= !line.trim_ascii().is_empty(),
            Err(_) => return false,
        }
    }
    comments
}
