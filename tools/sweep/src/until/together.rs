//! One row of the rows of several samples.

use super::Samples;
use super::columns::{DOUBT, FETCHES, FREEDOM, HALF_WIDTH, MEASURED, Merge, SHARE, merge};
use crate::rows::Rows;
use crate::{SweepError, significant};
use pm_sampling::Ratio;

/// Digits of numbers that are no counts.
const DIGITS: u8 = 15;

impl Samples {
    /// The one row, with the columns of each; `ratio` is what all samples tell of fetches per query.
    ///
    /// # Errors
    /// If a column is none that `pm-cachesim` prints of a trace of windows, or a cell is no number.
    pub fn together(&self, ratio: &Ratio) -> Result<Rows, SweepError> {
        let row = self.names.iter().map(|name| self.cell(name, ratio)).collect::<Result<_, _>>()?;
        Ok(Rows { names: self.names.clone(), rows: vec![row] })
    }

    fn cell(&self, name: &str, ratio: &Ratio) -> Result<String, SweepError> {
        let unknown =
            || SweepError::new("pm-cachesim", format!("printed a column `{name}` that pm-sweep does not know"));
        let merge = merge(name).ok_or_else(unknown)?;
        let at = self.column(name).expect("a column of the table");
        let mut cells = self.rows.iter().map(|row| row[at].as_str());
        let number = |value: f64| if value.is_nan() { String::new() } else { significant(value, DIGITS) };
        Ok(match merge {
            Merge::Same => self.rows[0][at].clone(),
            Merge::Words => cells.collect::<Vec<_>>().join(" + "),
            Merge::Ratio => number(match name {
                FETCHES => ratio.value,
                HALF_WIDTH => ratio.half_width(),
                DOUBT => ratio.doubt,
                FREEDOM => ratio.spread.freedom,
                _ => unreachable!("a column of the ratio"),
            }),
            // What one sample does not know, all together do not.
            _ if cells.any(str::is_empty) => String::new(),
            Merge::Sum => number((0..self.rows.len()).try_fold(0.0, |sum, row| Ok(sum + self.number(row, name)?))?),
            Merge::Count => format!("{:.0}", self.mean(name, SHARE)?),
            Merge::Whole => number(self.mean(name, SHARE)?),
            Merge::Each => number(self.mean(name, MEASURED)?),
            Merge::WholeError => number(self.root(name, SHARE)?),
            Merge::EachError => number(self.root(name, MEASURED)?),
        })
    }

    /// What each sample adds, by its weight.
    fn parts(&self, name: &str, weight: &str) -> Result<Vec<f64>, SweepError> {
        let weights = (0..self.rows.len()).map(|row| self.number(row, weight)).collect::<Result<Vec<_>, _>>()?;
        let all: f64 = weights.iter().sum();
        weights.iter().enumerate().map(|(row, weight)| Ok(weight / all * self.number(row, name)?)).collect()
    }

    fn mean(&self, name: &str, weight: &str) -> Result<f64, SweepError> {
        Ok(self.parts(name, weight)?.iter().sum())
    }

    fn root(&self, name: &str, weight: &str) -> Result<f64, SweepError> {
        Ok(self.parts(name, weight)?.iter().map(|part| part * part).sum::<f64>().sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::until::columns::COLUMNS;

    /// A row with numbers in these columns, and 1 in the others.
    fn printed(numbers: &[(&str, &str)]) -> Vec<u8> {
        let names: Vec<String> = COLUMNS.iter().map(|(name, _)| (*name).to_owned()).collect();
        let cell =
            |name: &String| numbers.iter().find(|(known, _)| known == name).map_or("1", |(_, cell)| cell).to_owned();
        Rows { rows: vec![names.iter().map(cell).collect()], names }.to_csv()
    }

    #[test]
    fn two_samples_as_one_by_hand() {
        let one = [
            ("sample", "30 windows"),
            ("order", "tiled"),
            ("queries", "90"),
            ("fetches_error", "3"),
            ("reads_per_query", "10"),
            ("reads_per_query_error", "3"),
            (FETCHES, "4"),
            (HALF_WIDTH, "0.7"),
            (DOUBT, "0.1"),
            (FREEDOM, "9"),
            ("windows", "30"),
            (MEASURED, "300"),
            (SHARE, "0.25"),
            ("compulsory", ""),
        ];
        let other =
            [("queries", "101"), ("reads_per_query", "20"), (MEASURED, "100"), (SHARE, "0.75"), ("windows", "8")];
        let other = [&other[..], &[("reads_per_query_error", "12"), ("fetches_error", "4"), (DOUBT, "0")]].concat();
        let mut samples = Samples::default();
        let first = samples.add(&printed(&one)).unwrap();
        assert_eq!((first.value, first.weight, first.doubt), (4.0, 300.0, 0.1));
        assert!((first.half_width() - 0.7).abs() < 1e-12);
        let ratio = first.with(samples.add(&printed(&other)).unwrap());
        let Rows { names, rows } = samples.together(&ratio).unwrap();
        let cell = |name: &str| rows[0][names.iter().position(|other| other == name).unwrap()].as_str();
        assert_eq!((cell("sample"), cell("order")), ("30 windows + 1", "tiled"));
        assert_eq!((cell("windows"), cell(MEASURED), cell(SHARE)), ("38", "400", "1"));
        // 90/4 + 3 * 101/4, to the next whole; (3 * 10 + 20) / 4.
        assert_eq!((cell("queries"), cell("reads_per_query"), cell("compulsory")), ("98", "12.5", ""));
        // Roots of (3/4)^2 + 3^2 and of (9/4)^2 + 3^2.
        assert_eq!((cell("fetches_error"), cell("reads_per_query_error")), ("3.09232921921325", "3.75"));
        assert_eq!((cell(FETCHES), cell(DOUBT)), ("3.25", "0.075"));
        assert_eq!(cell(HALF_WIDTH), significant(ratio.half_width(), 15));
        assert_eq!(samples.in_words(&ratio).split(':').next(), Some("38 windows, 2 queries simulated"));
    }

    #[test]
    fn what_is_no_sample_is_refused() {
        let mut samples = Samples::default();
        let why = |samples: &mut Samples, printed: &[u8]| samples.add(printed).unwrap_err().what;
        assert!(why(&mut samples, b"fetches\n1\n2\n").contains("several caches"));
        assert!(why(&mut samples, b"fetches\n1\n").contains("no row of a trace of windows"));
        assert!(why(&mut samples, &printed(&[(FETCHES, "many")])).contains("`many`"));
        let ratio = samples.add(&printed(&[])).unwrap();
        assert!(why(&mut samples, b"windows,fetches_per_query_doubt\n1,1\n").contains("other columns"));
        samples.names[0] = "strange".into();
        assert!(samples.together(&ratio).unwrap_err().what.contains("`strange`"));
    }
}
