//! A table with all its points.

use crate::line::Given;
use crate::pipe::for_target;
use crate::point::{combinations, point};
use crate::{Point, Table, TableError, Words, check};
use std::collections::BTreeMap;

/// The points of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sweep {
    /// Its name, and that of the folder of its rows.
    pub name: String,
    /// What its table is called in messages.
    pub file: String,
    /// Names of its labels.
    pub labels: Vec<String>,
    /// Its points, in the order of the table.
    pub points: Vec<Point>,
}

impl Sweep {
    /// The points of a table, which is called `name`; `variable` is the value of a variable that a cell names as `$(NAME)`.
    ///
    /// # Errors
    /// If a column or a label is used by nobody, a word is none of its vocabulary, a point stands twice or does what another
    /// does, or make or a shell would misread something.
    pub fn new(
        name: &str,
        table: &Table,
        words: &Words,
        variable: &dyn Fn(&str) -> Option<String>,
    ) -> Result<Self, TableError> {
        let lines = table.lines.iter().map(|line| Given::new(table, line, variable)).collect::<Result<Vec<_>, _>>()?;
        let mut sweep = Self {
            name: name.into(),
            file: table.file.clone(),
            labels: table.labels().map(str::to_owned).collect(),
            points: vec![],
        };
        check::columns(table, &lines, words)?;
        let mut first: BTreeMap<String, u64> = BTreeMap::new();
        for given in &lines {
            check::line(table, given, words)?;
            let error = |what: String| table.error(given.line, what);
            let mut of_line: Vec<Point> = vec![];
            for chosen in combinations(given) {
                let point = point(given, &chosen, words).map_err(error)?;
                if let Some(line) = first.insert(point.name.clone(), given.line) {
                    let where_else = if line == given.line { String::new() } else { format!(" (line {line})") };
                    return Err(error(format!("the point {} stands twice in the table{where_else}", point.name)));
                }
                if let Some(same) = of_line.iter().find(|other| other.work == point.work) {
                    let (a, b) = (&same.name, &point.name);
                    return Err(error(format!(
                        "the points {a} and {b} run the same command: what tells them apart changes nothing"
                    )));
                }
                of_line.push(point);
            }
            for mut point in of_line {
                point.work.command = for_target(&point.work.command, &sweep.target(&point));
                sweep.points.push(point);
            }
        }
        Ok(sweep)
    }

    /// The file of a point's rows, without its ending.
    fn target(&self, point: &Point) -> String {
        format!("out/{}/{}", self.name, point.name)
    }

    /// The file of a point's rows.
    #[must_use]
    pub fn rows_of(&self, point: &Point) -> String {
        format!("{}.csv", self.target(point))
    }

    /// The file of all rows.
    #[must_use]
    pub fn joined(&self) -> String {
        format!("out/{}.csv", self.name)
    }
}
