//! What light must be: the rows of a table of what is known.

use super::tolerance::Tolerance;
use crate::Table;
use crate::measured::CHANNELS;
use crate::table::Row;
use pm_report::ReportError;
use pm_report::sheet::number;

/// Something that is known.
#[derive(Clone, Debug)]
pub(super) struct Known {
    pub(super) experiment: String,
    pub(super) part: String,
    /// What it is.
    pub(super) what: String,
    pub(super) value: Source,
    /// Its standard errors; 0 where there is none.
    pub(super) error: [f64; 3],
    pub(super) tolerance: Tolerance,
}

/// Where a known value is from.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// Here.
    Values([Option<f64>; 3]),
    /// The same part of another experiment.
    Experiment(String),
}

impl Known {
    /// The rows of a table.
    ///
    /// # Errors
    /// If a column is missing, or a tolerance or value cannot be read, with its line.
    pub(super) fn read(table: &Table) -> Result<Vec<Self>, ReportError> {
        table.rows().map(Self::of_row).collect()
    }

    fn of_row(row: Row<'_>) -> Result<Self, ReportError> {
        let value = |name: &str| match row.text(name)? {
            "" => Ok(None),
            text => {
                number(text).map(Some).ok_or_else(|| row.wrong(format!("`{text}` in column {name} is not a number")))
            }
        };
        let [r, g, b] = CHANNELS;
        let error = |channel: &str| row.number(&format!("se_{channel}"));
        Ok(Self {
            experiment: row.text("experiment")?.to_owned(),
            part: row.text("part")?.to_owned(),
            what: row.text("what")?.to_owned(),
            value: match row.text(r)?.strip_prefix('=') {
                Some(other) => Source::Experiment(other.to_owned()),
                None => Source::Values([value(r)?, value(g)?, value(b)?]),
            },
            error: [error(r)?, error(g)?, error(b)?],
            tolerance: row.text("tolerance")?.parse().map_err(|error: String| row.wrong(error))?,
        })
    }
}
