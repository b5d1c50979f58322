//! The rows of a sweep as one table, the labels of each point in front.

use crate::rows::Rows;
use crate::{Sweep, SweepError};

/// The columns in front: the point's name and its labels.
const POINT: &str = "point";

/// Joins the rows of all points, which `read` gives by the names of their files.
///
/// A column of the same name as a label gives way to the label. Rows may have different columns: all are kept, empty where a
/// row has none.
///
/// # Errors
/// If rows are missing or cannot be believed.
pub fn join(sweep: &Sweep, read: impl Fn(&str) -> Option<Vec<u8>>) -> Result<Rows, SweepError> {
    let front: Vec<String> = [POINT].into_iter().map(str::to_owned).chain(sweep.labels.iter().cloned()).collect();
    let mut joined = Rows { names: front.clone(), rows: vec![] };
    for point in &sweep.points {
        let file = sweep.rows_of(point);
        let missing = || SweepError::new(&file, "has no row: remove it and run again");
        let rows = Rows::read(&file, &read(&file).ok_or_else(missing)?).map_err(|_| missing())?;
        let mut places = vec![];
        for name in &rows.names {
            places.push(match front.contains(name) {
                true => None,
                false => Some(joined.column(name).unwrap_or_else(|| {
                    joined.names.push(name.clone());
                    joined.names.len() - 1
                })),
            });
        }
        for row in rows.rows {
            let mut cells: Vec<String> = [point.name.clone()].into_iter().chain(point.words.iter().cloned()).collect();
            cells.resize(joined.names.len(), String::new());
            for (place, cell) in places.iter().zip(row) {
                if let Some(place) = place {
                    cells[*place] = cell;
                }
            }
            joined.rows.push(cells);
        }
    }
    let width = joined.names.len();
    joined.rows.iter_mut().for_each(|row| row.resize(width, String::new()));
    Ok(joined)
}

/// Tables with the same columns as one.
///
/// # Errors
/// If one has no row, or other columns than the first.
pub fn stack(tables: impl IntoIterator<Item = (String, Vec<u8>)>) -> Result<Rows, SweepError> {
    let mut all = Rows::default();
    for (file, bytes) in tables {
        let rows = Rows::read(&file, &bytes)?;
        if all.names.is_empty() {
            all.names.clone_from(&rows.names);
        }
        if all.names != rows.names {
            return Err(SweepError::new(&file, "has other columns than the tables before it"));
        }
        all.rows.extend(rows.rows);
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Table, Words};

    fn sweep() -> Sweep {
        let table = "k,(found),gather\n1 2,\"a\",-k {k}\n";
        Sweep::new("s", &Table::read("s.csv", table).unwrap(), &Words::default(), &|_| None).unwrap()
    }

    #[test]
    fn labels_stand_in_front_and_columns_are_kept() {
        let read = |file: &str| match file {
            "out/s/1.a.csv" => Some(b"k,fetches,cache\n9,5,\"4K,full\"\n9,6,none\n".to_vec()),
            "out/s/2.a.csv" => Some(b"windows,fetches\n3,7\n".to_vec()),
            _ => None,
        };
        let joined = join(&sweep(), read).unwrap().to_csv();
        let expected = "point,k,found,fetches,cache,windows\n1.a,1,a,5,\"4K,full\",\n1.a,1,a,6,none,\n2.a,2,a,7,,3\n";
        assert_eq!(String::from_utf8(joined).unwrap(), expected);
    }

    #[test]
    fn rows_that_are_missing_are_named() {
        for bytes in [None, Some(b"fetches\n".to_vec()), Some(b"fetches,x\n1\n".to_vec())] {
            let error =
                join(&sweep(), |file| if file.contains("/2.") { bytes.clone() } else { Some(b"x\n1\n".to_vec()) });
            assert_eq!(error.unwrap_err().to_string(), "out/s/2.a.csv: has no row: remove it and run again");
        }
    }

    #[test]
    fn tables_are_stacked_if_they_have_the_same_columns() {
        let table = |text: &str| ("t.csv".to_owned(), text.as_bytes().to_vec());
        assert_eq!(stack([table("a,b\n1,2\n"), table("a,b\n3,4\n5,6\n")]).unwrap().to_csv(), b"a,b\n1,2\n3,4\n5,6\n");
        assert!(stack([table("a,b\n1,2\n"), table("a,c\n3,4\n")]).unwrap_err().what.contains("other columns"));
        assert!(stack([table("a,b\n1,2\n"), table("a,b\n")]).is_err());
    }
}
