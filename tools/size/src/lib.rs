//! Byte sizes as people write them: `512`, `128K`, `64MiB`.

use std::{fmt, str::FromStr};

use thiserror::Error;

/// A number of bytes, read and printed as `512`, `128K`, `64M`.
///
/// `K` and `KiB` are 1024 bytes, and so on in powers of 1024 up to `E`; upper or lower case does not matter. `KB` is
/// refused, since half of its readers take it for 1000. Printing uses the largest unit that divides the number exactly,
/// so what was printed reads back as the same number.
///
/// ```
/// use pm_size::Bytes;
/// assert_eq!("128KiB".parse::<Bytes>().unwrap(), Bytes(131072));
/// assert_eq!(Bytes(131072).to_string(), "128K");
/// assert_eq!(Bytes(1000).to_string(), "1000");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Bytes(pub u64);

/// One letter for each power of 1024.
const UNITS: [char; 6] = ['K', 'M', 'G', 'T', 'P', 'E'];

/// Why a text is not a byte size.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SizeError {
    /// No digits where the number should be.
    #[error("`{0}` is not a size: write a whole number of bytes, such as 512, 128K or 64MiB")]
    NotANumber(String),
    /// Something other than a known unit after the number.
    #[error("`{text}` is not a size: `{unit}` is no unit; K, M, G, T, P and E (or KiB, MiB, ...) are powers of 1024")]
    Unit {
        /// What was written.
        text: String,
        /// The part that is not a unit.
        unit: String,
    },
    /// `KB`, `MB`, ...: 1000 to some and 1024 to others.
    #[error(
        "`{number}{unit}` could mean 1000s or 1024s: write {number}{letter} (or {number}{letter}iB) for powers of 1024"
    )]
    Ambiguous {
        /// The digits.
        number: String,
        /// The unit as written.
        unit: String,
        /// The unit that would do.
        letter: char,
    },
    /// More than `u64` holds.
    #[error("`{0}` is too large: a size is at most 18446744073709551615 bytes")]
    TooLarge(String),
}

impl FromStr for Bytes {
    type Err = SizeError;

    fn from_str(text: &str) -> Result<Self, SizeError> {
        let digits = text.bytes().take_while(u8::is_ascii_digit).count();
        let (number, unit) = text.split_at(digits);
        if number.is_empty() {
            return Err(SizeError::NotANumber(text.to_owned()));
        }
        let factor = factor(number, unit, text)?;
        // Digits only, so the one way this can fail is by their number.
        let number: u64 = number.parse().map_err(|_| SizeError::TooLarge(text.to_owned()))?;
        number.checked_mul(factor).map(Bytes).ok_or_else(|| SizeError::TooLarge(text.to_owned()))
    }
}

/// Bytes per unit.
fn factor(number: &str, unit: &str, text: &str) -> Result<u64, SizeError> {
    let upper = unit.to_ascii_uppercase();
    if upper.is_empty() || upper == "B" {
        return Ok(1);
    }
    for (i, letter) in UNITS.into_iter().enumerate() {
        if let Some(rest) = upper.strip_prefix(letter) {
            match rest {
                "" | "IB" => return Ok(1 << (10 * (i + 1))),
                "B" => {
                    let (number, unit) = (number.to_owned(), unit.to_owned());
                    return Err(SizeError::Ambiguous { number, unit, letter });
                }
                _ => {}
            }
        }
    }
    // `1.5M` and `1 M` are numbers to a human: say what is missing rather than that `.5M` is no unit.
    if unit.starts_with(['.', ',', '_', ' ']) {
        return Err(SizeError::NotANumber(text.to_owned()));
    }
    Err(SizeError::Unit { text: text.to_owned(), unit: unit.to_owned() })
}

impl fmt::Display for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let units = (self.0.trailing_zeros() / 10) as usize;
        if self.0 == 0 || units == 0 {
            return f.pad(&self.0.to_string());
        }
        f.pad(&format!("{}{}", self.0 >> (10 * units), UNITS[units - 1]))
    }
}

impl From<Bytes> for u64 {
    fn from(bytes: Bytes) -> u64 {
        bytes.0
    }
}

#[cfg(test)]
mod tests;
