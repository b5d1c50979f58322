//! Rows of numbers: lines of text, or records of f32.

use super::Import;
use super::columns::{Columns, names_of};
use crate::fault::bad_question;
use anyhow::{Context as _, anyhow, bail, ensure};
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

/// A field, as the file has it.
#[derive(Clone, Copy, Debug)]
enum Cell<'a> {
    Text(&'a str),
    Number(f32),
}

/// A row of a file.
pub(super) struct Row<'a> {
    cells: Vec<Cell<'a>>,
    names: &'a [String],
    place: String,
    /// Rows before this one.
    pub(super) number: u64,
}

impl Row<'_> {
    /// The error that something about this row is wrong.
    pub(super) fn wrong(&self, what: impl std::fmt::Display) -> anyhow::Error {
        anyhow!("{}: {what}", self.place)
    }

    fn wrong_cell(&self, column: usize, needed: &str) -> anyhow::Error {
        let name = &self.names[column];
        match self.cells[column] {
            Cell::Text("") => self.wrong(format!("{name} is missing")),
            Cell::Text(text) => self.wrong(format!("{name} is `{}`; {needed} is needed", text.escape_debug())),
            Cell::Number(x) => self.wrong(format!("{name} is {x}; {needed} is needed")),
        }
    }

    /// A finite number.
    pub(super) fn number(&self, column: usize) -> anyhow::Result<f32> {
        let number = match self.cells[column] {
            Cell::Text(text) => text.parse().ok(),
            Cell::Number(x) => Some(x),
        };
        number.filter(|x| x.is_finite()).ok_or_else(|| self.wrong_cell(column, "a finite number"))
    }

    /// Three finite numbers.
    pub(super) fn triple(&self, columns: [usize; 3]) -> anyhow::Result<[f32; 3]> {
        let [x, y, z] = columns.map(|column| self.number(column));
        Ok([x?, y?, z?])
    }

    /// A vector that has a direction, of whatever length.
    pub(super) fn direction(&self, columns: [usize; 3]) -> anyhow::Result<[f32; 3]> {
        let vector = self.triple(columns)?;
        if vector == [0.0; 3] {
            return Err(self.wrong(format!("{} and its like are 0: that is no direction", self.names[columns[0]])));
        }
        // The sum of the components must stay finite too.
        let largest = vector.into_iter().fold(0.0, |largest: f32, x| largest.max(x.abs()));
        Ok(if largest > 1.0 { vector.map(|x| x / largest) } else { vector })
    }

    /// A whole number of 0 to `most`.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "compared afterwards")]
    pub(super) fn whole(&self, column: usize, most: u64) -> anyhow::Result<u64> {
        let number = match self.cells[column] {
            Cell::Text(text) => text.parse().ok(),
            // Beyond 2^24 a whole number in f32 need not be the one that was meant.
            Cell::Number(x) => Some(x as u64).filter(|&n| n as f32 == x && x.is_sign_positive() && n <= 1 << 24),
        };
        let needed = || format!("a whole number of 0 to {most}");
        number.filter(|&n| n <= most).ok_or_else(|| self.wrong_cell(column, &needed()))
    }
}

/// Rows of a file, one after the other.
pub(super) struct Rows<R> {
    input: R,
    pub(super) columns: Columns,
    form: Form,
    /// Rows given out.
    count: u64,
}

enum Form {
    Text { line: String, number: u64, separator: Separator, held: bool },
    Raw { bytes: Vec<u8> },
}

impl<R: BufRead> Rows<R> {
    /// Reads as far as the names of the columns.
    ///
    /// # Errors
    /// If there are no names, or the input cannot be read.
    pub(super) fn new(mut input: R, import: &Import) -> anyhow::Result<Self> {
        if import.raw {
            let Some(names) = import.columns.clone() else {
                return Err(bad_question("--raw needs --columns: which number of a record is what"));
            };
            let form = Form::Raw { bytes: vec![0; names.len() * 4] };
            return Ok(Self { input, columns: Columns::new(names, true)?, form, count: 0 });
        }
        let (mut line, mut number) = (String::new(), 0);
        let some = next_line(&mut input, &mut line, &mut number, import.columns.is_none())?;
        let text = line.trim_start_matches(['\u{feff}', '#', ' ']).to_owned();
        let separator = Separator::of(text.trim());
        let fields = separator.split(text.trim());
        let (columns, held) = match &import.columns {
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
        Ok(Self { input, columns, form: Form::Text { line, number, separator, held }, count: 0 })
    }

    /// The next row.
    ///
    /// # Errors
    /// If it has another number of fields, or cannot be read.
    pub(super) fn next(&mut self) -> anyhow::Result<Option<Row<'_>>> {
        let wanted = self.columns.names.len();
        let (cells, place) = match &mut self.form {
            Form::Text { line, number, separator, held } => {
                if !std::mem::take(held) && !next_line(&mut self.input, line, number, false)? {
                    return Ok(None);
                }
                let cells: Vec<Cell> =
                    separator.split(line.trim_end_matches(['\r', '\n'])).into_iter().map(Cell::Text).collect();
                let found = cells.len();
                ensure!(found == wanted, "line {number}: {found} fields, but there are {wanted} columns");
                (cells, format!("line {number}"))
            }
            Form::Raw { bytes } => {
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
