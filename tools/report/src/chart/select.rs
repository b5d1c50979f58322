//! From tables to series: which columns, which rows.

use super::{Axis, Plot, Point, Scale, Series};
use std::io::Read;
use std::path::Path;
use thiserror::Error;

/// Which part of the tables is drawn.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// The column across. Its values may be words.
    pub x: String,
    /// The column up.
    pub y: String,
    /// The columns whose values together name a series; none: the tables' names do.
    pub by: Vec<String>,
    /// The column of half widths of intervals around y.
    pub error: Option<String>,
    /// Only rows that have these values in these columns; of several values of a column, any.
    pub only: Vec<(String, String)>,
    /// Scale of x.
    pub x_scale: Scale,
    /// Scale of y.
    pub y_scale: Scale,
}

/// Why no plot comes of a table.
#[derive(Debug, Error)]
pub enum TableError {
    /// It is not CSV.
    #[error("{table}: {source}")]
    Csv {
        /// Name of the table.
        table: String,
        /// What is wrong.
        source: csv::Error,
    },
    /// There is not even a line of names.
    #[error("{0}: the table is empty")]
    Empty(String),
    /// A column is not there.
    #[error("{table}: there is no column `{column}`; there are {columns}")]
    Column {
        /// Name of the table.
        table: String,
        /// The column asked for.
        column: String,
        /// The columns there are.
        columns: String,
    },
    /// A field is not a number.
    #[error("{table}, line {line}: `{text}` in column {column} is not a number")]
    Number {
        /// Name of the table.
        table: String,
        /// Line, the first being 1.
        line: u64,
        /// What stands there.
        text: String,
        /// In which column.
        column: String,
    },
    /// Zero or less on a logarithmic axis.
    #[error(
        "{value} in column {column} has no place on a logarithmic axis; choose `linear`, or leave it out by --only"
    )]
    NotPositive {
        /// The value.
        value: f64,
        /// The column.
        column: String,
    },
    /// No row is left.
    #[error("no row has a value in both {x} and {y}{}", if *filtered { " and fits --only" } else { "" })]
    Nothing {
        /// The column across.
        x: String,
        /// The column up.
        y: String,
        /// Were rows left out by choice?
        filtered: bool,
    },
}

/// A row that is drawn, x as it is written.
struct Row {
    series: String,
    x: String,
    y: f64,
    error: Option<f64>,
    table: usize,
    line: u64,
}

impl Plot {
    /// Makes a plot of CSV tables, each with its name, and of tables with points to compare with.
    ///
    /// Rows without a value in x or y (an empty field) are passed over.
    ///
    /// # Errors
    /// See [`TableError`].
    pub fn read<R: Read>(
        selection: &Selection,
        tables: Vec<(String, R)>,
        references: Vec<(String, R)>,
    ) -> Result<Self, TableError> {
        let ours = tables.len();
        let mut rows = vec![];
        let mut names = vec![];
        for (table, (name, text)) in tables.into_iter().chain(references).enumerate() {
            read_table(selection, (table, table >= ours), &name, text, &mut rows)?;
            names.push(name);
        }
        if rows.iter().all(|row| row.table >= ours) {
            let filtered = !selection.only.is_empty();
            return Err(TableError::Nothing { x: selection.x.clone(), y: selection.y.clone(), filtered });
        }

        // An axis is of words as soon as one of our own values is a word.
        let number = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
        let of_words = rows.iter().any(|row| row.table < ours && number(&row.x).is_none());
        let mut words: Vec<String> = vec![];
        let mut xs = vec![];
        for row in &rows {
            xs.push(if of_words {
                let known = words.iter().position(|word| *word == row.x);
                known.unwrap_or_else(|| {
                    words.push(row.x.clone());
                    words.len() - 1
                }) as f64
            } else {
                let wrong = || TableError::Number {
                    table: names[row.table].clone(),
                    line: row.line,
                    text: row.x.clone(),
                    column: selection.x.clone(),
                };
                number(&row.x).ok_or_else(wrong)?
            });
        }

        let not_positive = |column: &str| {
            let column = column.to_owned();
            move |value| TableError::NotPositive { value, column }
        };
        let x = Axis::fit(&selection.x, selection.x_scale, words, xs.iter().copied())
            .map_err(not_positive(&selection.x))?;
        let y = Axis::fit(&selection.y, selection.y_scale, vec![], rows.iter().map(|row| row.y))
            .map_err(not_positive(&selection.y))?;
        let (mut series, mut reference) = (vec![], vec![]);
        for (row, x) in rows.into_iter().zip(xs) {
            let side = if row.table < ours { &mut series } else { &mut reference };
            let point = Point { x, y: row.y, error: row.error };
            match side.iter_mut().find(|series: &&mut Series| series.name == row.series) {
                Some(known) => known.points.push(point),
                None => side.push(Series { name: row.series, points: vec![point] }),
            }
        }
        if !of_words {
            // Lines go from left to right, in whatever order the rows came.
            let all = series.iter_mut().chain(&mut reference);
            all.for_each(|series| series.points.sort_by(|a, b| a.x.total_cmp(&b.x)));
        }
        Ok(Self { x, y, series, reference })
    }
}

fn read_table(
    selection: &Selection,
    (table, is_reference): (usize, bool),
    name: &str,
    text: impl Read,
    rows: &mut Vec<Row>,
) -> Result<(), TableError> {
    let csv_error = |source| TableError::Csv { table: name.to_owned(), source };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text);
    let headers = reader.headers().map_err(csv_error)?.clone();
    if headers.is_empty() {
        return Err(TableError::Empty(name.to_owned()));
    }
    let column = |wanted: &str| {
        headers.iter().position(|header| header == wanted).ok_or_else(|| TableError::Column {
            table: name.to_owned(),
            column: wanted.to_owned(),
            columns: headers.iter().collect::<Vec<_>>().join(", "),
        })
    };
    let (x, y) = (column(&selection.x)?, column(&selection.y)?);
    // What is compared with need not have all columns that ours have.
    let known = |wanted: &str| !is_reference || headers.iter().any(|header| header == wanted);
    let error = selection.error.as_deref().filter(|wanted| known(wanted)).map(column).transpose()?;
    let by = selection.by.iter().filter(|wanted| known(wanted)).map(|wanted| column(wanted));
    let by = by.collect::<Result<Vec<_>, _>>()?;
    let only = selection.only.iter().filter(|(wanted, _)| known(wanted));
    let only = only.map(|(wanted, value)| Ok((column(wanted)?, value)));
    let only = only.collect::<Result<Vec<_>, TableError>>()?;

    for record in reader.records() {
        let record = record.map_err(csv_error)?;
        let field = |column: usize| record.get(column).unwrap_or_default();
        let fits = |wanted: usize| only.iter().any(|&(column, value)| column == wanted && field(column) == value);
        if field(x).is_empty() || field(y).is_empty() || !only.iter().all(|&(column, _)| fits(column)) {
            continue;
        }
        let line = record.position().map_or(0, csv::Position::line);
        let number = |column: usize| {
            field(column).parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(|| TableError::Number {
                table: name.to_owned(),
                line,
                text: field(column).to_owned(),
                column: headers.get(column).unwrap_or_default().to_owned(),
            })
        };
        let series = by.iter().map(|&column| field(column)).filter(|part| !part.is_empty()).collect::<Vec<_>>();
        rows.push(Row {
            series: if series.is_empty() { stem(name) } else { series.join(", ") },
            x: field(x).to_owned(),
            y: number(y)?,
            error: error.filter(|&column| !field(column).is_empty()).map(number).transpose()?,
            table,
            line,
        });
    }
    Ok(())
}

/// What a table is called in the legend: a file's name without folder and ending.
fn stem(name: &str) -> String {
    Path::new(name).file_stem().map_or_else(|| name.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "\
order,cache,size,fetches,width
scanline,\"4K,full,128,lru\",4096,100,2
hilbert,\"4K,full,128,lru\",4096,50,
scanline,\"8K,full,128,lru\",8192,80,1
hilbert,\"8K,full,128,lru\",8192,,
";

    fn selection() -> Selection {
        Selection { x: "size".into(), y: "fetches".into(), by: vec!["order".into()], ..Selection::default() }
    }

    fn read(selection: &Selection, table: &str) -> Result<Plot, TableError> {
        Plot::read(selection, vec![("t.csv".to_owned(), table.as_bytes())], vec![])
    }

    #[test]
    fn series_come_by_name_and_rows_without_a_value_are_passed_over() {
        let selection = Selection { error: Some("width".into()), ..selection() };
        let plot = read(&selection, TABLE).unwrap();
        let names: Vec<_> = plot.series.iter().map(|s| (s.name.as_str(), s.points.len())).collect();
        assert_eq!(names, [("scanline", 2), ("hilbert", 1)]);
        assert_eq!(plot.series[0].points[1], Point { x: 8192.0, y: 80.0, error: Some(1.0) });
        assert_eq!(plot.series[1].points[0].error, None);
    }

    #[test]
    fn of_several_values_of_a_column_any_does() {
        let only = [("size", "8192"), ("size", "4096"), ("order", "scanline")];
        let only = only.map(|(column, value)| (column.to_owned(), value.to_owned())).to_vec();
        let plot = read(&Selection { only, ..selection() }, TABLE).unwrap();
        let points = |series: &Series| (series.name.clone(), series.points.len());
        assert_eq!(plot.series.iter().map(points).collect::<Vec<_>>(), [("scanline".to_owned(), 2)]);
    }

    #[test]
    fn references_need_only_the_columns_of_the_axes() {
        let selection = Selection { only: vec![("order".into(), "hilbert".into())], ..selection() };
        let paper = vec![("p.csv".to_owned(), "size,fetches\n4096,58\n".as_bytes())];
        let plot = Plot::read(&selection, vec![("t.csv".to_owned(), TABLE.as_bytes())], paper).unwrap();
        assert_eq!((plot.reference[0].name.as_str(), plot.reference[0].points.len()), ("p", 1));
    }

    #[test]
    fn lines_go_from_left_to_right() {
        let plot = read(&selection(), "order,size,fetches\na,512,1\na,32,2\na,64,3\n").unwrap();
        assert_eq!(
            plot.series[0].points.iter().map(|p| (p.x, p.y)).collect::<Vec<_>>(),
            [(32.0, 2.0), (64.0, 3.0), (512.0, 1.0)]
        );
    }

    #[test]
    fn words_make_an_axis_of_words() {
        let selection = Selection { x: "cache".into(), by: vec![], ..selection() };
        let plot = read(&selection, TABLE).unwrap();
        assert_eq!(plot.x.words, ["4K,full,128,lru", "8K,full,128,lru"]);
        assert_eq!(plot.series[0].name, "t");
        assert_eq!(plot.series[0].points.iter().map(|p| p.x).collect::<Vec<_>>(), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn refusals_say_where() {
        let hint = |selection: &Selection, table: &str| read(selection, table).unwrap_err().to_string();
        let x = |x: &str| Selection { x: x.into(), ..selection() };
        assert_eq!(
            hint(&x("sise"), TABLE),
            "t.csv: there is no column `sise`; there are order, cache, size, fetches, width"
        );
        let bad = "order,size,fetches\na,1,2\na,2,many\n";
        assert_eq!(hint(&selection(), bad), "t.csv, line 3: `many` in column fetches is not a number");
        let only = Selection { only: vec![("order".into(), "tiled".into())], ..selection() };
        assert_eq!(hint(&only, TABLE), "no row has a value in both size and fetches and fits --only");
        let log = Selection { y_scale: Scale::Log10, ..selection() };
        assert!(hint(&log, "order,size,fetches\na,1,0\n").starts_with("0 in column fetches has no place"));
        assert!(hint(&selection(), "order,size,fetches\na,1\n").starts_with("t.csv: CSV error: record 1"));
        assert_eq!(hint(&selection(), ""), "t.csv: the table is empty");
    }

    #[test]
    fn references_stand_apart() {
        let tables = vec![("t.csv".to_owned(), TABLE.as_bytes())];
        let paper = vec![("p.csv".to_owned(), "order,size,fetches\npaper,4096,58\n".as_bytes())];
        let plot = Plot::read(&selection(), tables, paper).unwrap();
        assert_eq!((plot.series.len(), plot.reference.len()), (2, 1));
        assert_eq!(plot.reference[0].name, "paper");
    }
}
