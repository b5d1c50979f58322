//! How numbers are written.

use pm_size::Bytes;
use std::str::FromStr;

/// A way to write numbers, spelt as Python does: `,` for groups of thousands, `.N` digits, and how: `f` decimals, `g`
/// significant digits (and no exponent for numbers of everyday size), `e` with an exponent, `%` as per cent with decimals,
/// `B` as bytes (`128K`, powers of 1024).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberFormat {
    grouped: bool,
    digits: Option<usize>,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// All digits that the number has.
    Plain,
    Decimals,
    Significant,
    Exponent,
    PerCent,
    Bytes,
}

/// More digits than a number has.
const MOST_DIGITS: usize = 17;

impl FromStr for NumberFormat {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!("`{text}` is not a format; expected are such as `.1f`, `.3g`, `,`, `,.0f`, `.1%`, `.2e` and `B`")
        };
        let (grouped, rest) = text.strip_prefix(',').map_or((false, text), |rest| (true, rest));
        let (digits, kind) = match rest.strip_prefix('.') {
            Some(rest) => {
                let end = rest.find(|c: char| !c.is_ascii_digit()).ok_or_else(wrong)?;
                let digits: usize = rest[..end].parse().map_err(|_| wrong())?;
                (Some(digits), &rest[end..])
            }
            None => (None, rest),
        };
        let kind = match kind {
            "" if digits.is_none() => Kind::Plain,
            "f" => Kind::Decimals,
            "g" => Kind::Significant,
            "e" => Kind::Exponent,
            "%" => Kind::PerCent,
            "B" if !grouped => Kind::Bytes,
            _ => return Err(wrong()),
        };
        let fits = digits.is_none_or(|digits| digits <= MOST_DIGITS && (digits > 0 || kind != Kind::Significant));
        fits.then_some(Self { grouped, digits, kind }).ok_or_else(wrong)
    }
}

impl NumberFormat {
    /// Writes a number.
    #[must_use]
    pub fn write(&self, value: f64) -> String {
        let digits = self.digits;
        let text = match self.kind {
            Kind::Plain => value.to_string(),
            Kind::Decimals => format!("{value:.0$}", digits.unwrap_or(0)),
            Kind::Significant => significant(value, digits.unwrap_or(3)),
            Kind::Exponent => format!("{value:.0$e}", digits.unwrap_or(2)),
            Kind::PerCent => format!("{:.1$}\u{202f}%", 100.0 * value, digits.unwrap_or(0)),
            Kind::Bytes => bytes(value, digits.unwrap_or(3).max(1)),
        };
        if self.grouped { group(&text) } else { text }
    }
}

/// So many significant digits; with an exponent only where there would be many zeros.
fn significant(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.0$e}", digits - 1);
    let exponent: i32 = scientific.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
    if value != 0.0 && !(-6..15).contains(&exponent) {
        return scientific;
    }
    // Rounded first, so that 9.99 of two digits is 10 and not 10.0.
    let rounded: f64 = scientific.parse().unwrap_or(value);
    let decimals = i32::try_from(digits).unwrap_or(0) - 1 - exponent;
    format!("{rounded:.0$}", usize::try_from(decimals).unwrap_or(0))
}

/// `128K` where that is short, else so many significant digits of the greatest unit that is not greater.
fn bytes(value: f64, digits: usize) -> String {
    if value >= 0.0 && value < 2.0_f64.powi(53) && value.fract() == 0.0 {
        let even = Bytes(value as u64).to_string();
        if even.trim_end_matches(|c: char| c.is_ascii_alphabetic()).len() <= 3 {
            return even;
        }
    }
    let units = ["", "K", "M", "G", "T"];
    let unit = (1..units.len()).rev().find(|&unit| value.abs() >= 1024.0_f64.powi(unit as i32)).unwrap_or(0);
    significant(value / 1024.0_f64.powi(unit as i32), digits) + units[unit]
}

/// Commas between groups of three digits before the point.
fn group(text: &str) -> String {
    let start = text.find(|c: char| c.is_ascii_digit()).unwrap_or(0);
    let end = text[start..].find(|c: char| !c.is_ascii_digit()).map_or(text.len(), |at| start + at);
    let digits = &text[start..end];
    let mut grouped = text[..start].to_owned();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped + &text[end..]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(format: &str, value: f64) -> String {
        format.parse::<NumberFormat>().unwrap_or_else(|error| panic!("{error}")).write(value)
    }

    #[test]
    fn numbers_are_written_as_asked() {
        // What Python 3 writes, but for `g`, which keeps its zeros (Python: `#g`), and the blank before the per cent.
        for (format, value, expected) in [
            (".1f", 71.0612, "71.1"),
            (",.0f", 1_216_639.0, "1,216,639"),
            (",", 12_345.678, "12,345.678"),
            (",", -999.0, "-999"),
            (",", -1000.0, "-1,000"),
            (".3g", 71.0612, "71.1"),
            (".3g", 0.024_309, "0.0243"),
            (".3g", 34_219.06, "34200"),
            (".2g", 9.99, "10"),
            (".3g", 2.0, "2.00"),
            (".2g", 1.5e-9, "1.5e-9"),
            (".2g", 0.0, "0.0"),
            (".1%", 0.3914, "39.1\u{202f}%"),
            (".2e", 0.000_123_4, "1.23e-4"),
            ("B", 131_072.0, "128K"),
            ("B", 100.0, "100"),
            ("B", 9_763_246_080.0, "9.09G"),
            (".2B", 1_500_000.0, "1.4M"),
            ("B", 3_785_600.0, "3.61M"),
            ("", 0.5, "0.5"),
        ] {
            assert_eq!(write(format, value), expected, "{format} {value}");
        }
    }

    #[test]
    fn what_is_no_format_is_refused() {
        for text in ["f2", ".f", ".", ".99f", ".0g", "x", ".1", ",B", "d"] {
            assert!(text.parse::<NumberFormat>().is_err(), "{text}");
        }
    }
}
