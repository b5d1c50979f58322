//! Rows of numbers: lines of text, or records of f32.

use super::RowOptions;
use super::columns::{Columns, names_of};
use super::row::{Cell, Row};
use crate::fault::bad_question;
use anyhow::{Context as _, bail, ensure};
use std::io::{BufRead, ErrorKind, Read};

/// Longest line, in bytes: a file without line ends is no table.
const MOST_BYTES: u64 = 1 << 20;

/// What parts the fields of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Separator {
    Letter(char),
    Blanks,
}

impl Separator {
    /// The separator of a file with this first line.
    fn of(line: &str) -> Self {
        ['\t', ';', ','].into_iter().find(|&c| line.contains(c)).map_or(Self::Blanks, Self::Letter)
    }

    fn split(self, line: &str) -> Vec<&str> {
        match self {
            Self::Letter(letter) => line.split(letter).map(str::trim).collect(),
            Self::Blanks => line.split_whitespace().collect(),
        }
    }
}

/// Rows of a file, one after the other.
pub(super) struct Rows<R> {
    input: R,
    pub(super) columns: Columns,
    encoding: Encoding,
    /// Rows given out.
    count: u64,
}

/// How the rows stand in the file.
enum Encoding {
    Text { line: String, number: u64, separator: Separator, held: bool },
    Raw { bytes: Vec<u8> },
}

impl<R: BufRead> Rows<R> {
    /// Reads as far as the names of the columns.
    ///
    /// # Errors
    /// If there are no names, or the input cannot be read.
    pub(super) fn new(mut input: R, options: &RowOptions) -> anyhow::Result<Self> {
        if options.raw {
            let Some(names) = options.columns.clone() else {
                return Err(bad_question("--raw needs --columns: which number of a record is what"));
            };
            let encoding = Encoding::Raw { bytes: vec![0; names.len() * 4] };
            return Ok(Self { input, columns: Columns::new(names, true)?, encoding, count: 0 });
        }
        let (mut line, mut number) = (String::new(), 0);
        let some = next_line(&mut input, &mut line, &mut number, options.columns.is_none())?;
        let text = line.trim_start_matches(['\u{feff}', '#', ' ']).to_owned();
        let separator = Separator::of(text.trim());
        let fields = separator.split(text.trim());
        let (columns, held) = match &options.columns {
            None => {
                ensure!(some, "there is no line of names");
                (Columns::new(names_of(&fields)?, false)?, false)
            }
            Some(names) => {
                // A line of names may stand there all the same: the names typed go before it.
                let named = fields.iter().all(|field| field.parse::<f64>().is_err() && !field.is_empty());
                line = text.clone();
                (Columns::new(names.clone(), true)?, some && !named)
            }
        };
        Ok(Self { input, columns, encoding: Encoding::Text { line, number, separator, held }, count: 0 })
    }

    /// The next row.
    ///
    /// # Errors
    /// If it has another number of fields, or cannot be read.
    pub(super) fn next(&mut self) -> anyhow::Result<Option<Row<'_>>> {
        let wanted = self.columns.names.len();
        let (cells, place) = match &mut self.encoding {
            Encoding::Text { line, number, separator, held } => {
                if !std::mem::take(held) && !next_line(&mut self.input, line, number, false)? {
                    return Ok(None);
                }
                let cells: Vec<Cell> =
                    separator.split(line.trim_end_matches(['\r', '\n'])).into_iter().map(Cell::Text).collect();
                let found = cells.len();
                ensure!(found == wanted, "line {number}: {found} fields, but there are {wanted} columns");
                (cells, format!("line {number}"))
            }
            Encoding::Raw { bytes } => {
                let got = fill(&mut self.input, bytes)?;
                let record = self.count + 1;
                if got == 0 {
                    return Ok(None);
                }
                ensure!(
                    got == bytes.len(),
                    "record {record}: {got} bytes are left, but a record of {wanted} columns has {}",
                    bytes.len()
                );
                let numbers =
                    bytes.chunks_exact(4).map(|word| f32::from_le_bytes(word.try_into().expect("four bytes")));
                (numbers.map(Cell::Number).collect(), format!("record {record}"))
            }
        };
        let number = self.count;
        self.count += 1;
        Ok(Some(Row { cells, names: &self.columns.names, place, number }))
    }
}

/// Reads the next line that is neither blank nor a comment (`#`, unless `names` may stand there).
fn next_line(input: &mut impl BufRead, line: &mut String, number: &mut u64, names: bool) -> anyhow::Result<bool> {
    loop {
        *number += 1;
        line.clear();
        let read = Read::take(&mut *input, MOST_BYTES).read_line(line);
        let read = match read {
            Err(error) if error.kind() == ErrorKind::InvalidData => bail!("line {number} is no text; is it --raw f32?"),
            other => other.with_context(|| format!("line {number}"))?,
        };
        if read == 0 {
            return Ok(false);
        }
        ensure!((read as u64) < MOST_BYTES, "line {number} has no end; is it --raw f32?");
        let text = line.trim();
        if !text.is_empty() && (names || !text.starts_with('#')) {
            return Ok(true);
        }
    }
}

/// Fills `bytes` as far as the input goes.
fn fill(input: &mut impl BufRead, bytes: &mut [u8]) -> std::io::Result<usize> {
    let mut got = 0;
    while got < bytes.len() {
        match input.read(&mut bytes[got..]) {
            Ok(0) => break,
            Ok(n) => got += n,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(got)
}
