//! A row of numbers, and what is wrong with it.

use anyhow::anyhow;

/// A field, as the file has it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cell<'a> {
    Text(&'a str),
    Number(f32),
}

/// A row of a file.
pub(super) struct Row<'a> {
    pub(super) cells: Vec<Cell<'a>>,
    pub(super) names: &'a [String],
    /// Where it stands.
    pub(super) place: String,
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
