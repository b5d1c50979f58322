//! Whether what a point printed is its row.

use crate::SweepError;
use crate::rows::Rows;

/// Believes what a point printed, if it is whole and what printed it ended well.
///
/// # Errors
/// If it is not, or did not: with the last line of what was said on standard error meanwhile.
pub fn believed(file: &str, printed: &[u8], code: i32, said: &str) -> Result<(), SweepError> {
    let mut error = match Rows::read(file, printed) {
        Ok(_) if code == 0 => return Ok(()),
        Ok(_) => SweepError::new(file, "the row is not believed"),
        Err(error) => error,
    };
    if code != 0 {
        error.what += &format!("; what makes it ended with code {code}");
    }
    if let Some(last) = said.lines().rfind(|line| !line.trim().is_empty()) {
        error.what += &format!("; it said last: {}", last.trim());
    }
    Err(error)
}

#[cfg(test)]
mod tests {
    use super::believed;

    #[test]
    fn a_row_that_did_not_come_tells_why() {
        let told = |printed: &str, code: i32, said: &str| {
            believed("out/a.csv", printed.as_bytes(), code, said).map_err(|error| error.to_string())
        };
        let (row, said) = ("a\n1\n", "pm-gather: -k none is no number\n  try -k 10\n\n");
        assert_eq!(told(row, 0, said), Ok(()));
        assert_eq!(told("", 0, "").unwrap_err(), "out/a.csv: no row came back");
        let refused = told("", 2, said).unwrap_err();
        assert_eq!(refused, "out/a.csv: no row came back; what makes it ended with code 2; it said last: try -k 10");
        assert!(told(row, 137, "").unwrap_err().contains("not believed; what makes it ended with code 137"));
    }
}
