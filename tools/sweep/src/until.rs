//! Samples of one stream put together: `pm-cachesim --format csv` prints a row of each, and they become one row.
//!
//! Fetches per query are the ratio that windows are added for; [`pm_sampling`] puts it together and says what is missing. Of the
//! other columns [`columns`] tells how.

mod columns;
mod together;

use crate::rows::Rows;
use crate::{SweepError, significant};
use pm_sampling::Ratio;

/// Names of the columns that `pm-cachesim` prints of a trace of windows, without those of regions, in order.
pub fn columns() -> impl Iterator<Item = &'static str> {
    columns::COLUMNS.iter().map(|(name, _)| *name)
}

/// Rows of independent samples of one stream and one cache.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// Names of the columns.
    names: Vec<String>,
    /// A row of each.
    rows: Vec<Vec<String>>,
}

impl Samples {
    /// Adds what `pm-cachesim` printed of a sample; the ratio that it tells.
    ///
    /// # Errors
    /// If it is not one row of a trace of windows, with the columns of the samples before.
    pub fn add(&mut self, printed: &[u8]) -> Result<Ratio, SweepError> {
        let error = |what: &str| Err(SweepError::new("pm-cachesim", what));
        let Rows { names, rows } = Rows::read("pm-cachesim", printed)?;
        let [row] = &rows[..] else { return error("printed rows of several caches: give one") };
        let all = Self { names, rows: vec![row.clone()] };
        if all.column(columns::DOUBT).is_none() || all.column(columns::WINDOWS).is_none() {
            return error("printed no row of a trace of windows: samples of windows are put together");
        }
        if !self.rows.is_empty() && self.names != all.names {
            return error("printed other columns than of the samples before");
        }
        let number = |name| all.number(0, name);
        let value = number(columns::FETCHES)?;
        let (half_width, doubt) = (number(columns::HALF_WIDTH)?, number(columns::DOUBT)?);
        let ratio = Ratio::of_interval(value, number(columns::MEASURED)?, half_width, doubt, number(columns::FREEDOM)?);
        self.names = all.names;
        self.rows.extend(all.rows);
        Ok(ratio)
    }

    /// What is known so far, in a line for people.
    #[must_use]
    pub fn in_words(&self, ratio: &Ratio) -> String {
        let total = |name| (0..self.rows.len()).filter_map(|row| self.number(row, name).ok()).sum::<f64>();
        let (value, half_width) = (ratio.value, ratio.half_width());
        format!(
            "{:.0} windows, {:.0} queries simulated: {} +- {} fetches per query ({:.2} %)",
            total(columns::WINDOWS),
            total(columns::SIMULATED),
            significant(value, 5),
            significant(half_width, 2),
            100.0 * half_width / value
        )
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|other| other == name)
    }

    /// A number of a row; not a number where its cell is empty.
    fn number(&self, row: usize, name: &str) -> Result<f64, SweepError> {
        let error = |what: String| SweepError::new("pm-cachesim", what);
        let at = self.column(name).ok_or_else(|| error(format!("printed no column `{name}`")))?;
        let cell = &self.rows[row][at];
        if cell.is_empty() {
            return Ok(f64::NAN);
        }
        cell.parse().map_err(|_| error(format!("printed `{cell}` where {name} is a number")))
    }
}
