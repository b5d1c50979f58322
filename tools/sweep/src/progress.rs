//! How far a make is: which row of how many, and about how long the rest takes.

use std::str::FromStr;

/// The row that was begun as the n-th of so many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    number: u64,
    of: u64,
}

impl FromStr for Place {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        let place = numbers.map(|(number, of)| Self { number, of }).filter(|place| place.number > 0);
        place.ok_or_else(|| format!("`{text}`: a place such as 3/12 is expected"))
    }
}

impl Place {
    /// The place in words, so many seconds after the first was begun; and how long the rest takes if each takes as long.
    #[must_use]
    pub fn told(self, seconds: u64) -> String {
        let Self { number, of } = self;
        let of = of.max(number);
        let left = seconds as f64 / number as f64 * (of - number) as f64;
        let left = match left {
            _ if of == number => return format!("row {number} of {of}"),
            0.0..90.0 => format!("{left:.0} s"),
            90.0..5400.0 => format!("{:.0} min", left / 60.0),
            _ => format!("{:.1} h", left / 3600.0),
        };
        format!("row {number} of {of}, about {left} left")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_takes_as_long_for_each_row() {
        let told = |place: &str, seconds| place.parse::<Place>().unwrap().told(seconds);
        assert_eq!(told("1/5", 2), "row 1 of 5, about 8 s left");
        assert_eq!(told("10/40", 100), "row 10 of 40, about 5 min left");
        assert_eq!(told("1/101", 180), "row 1 of 101, about 5.0 h left");
        assert_eq!(told("5/5", 100), "row 5 of 5");
        // More than were foreseen, since something else made them necessary.
        assert_eq!(told("6/5", 100), "row 6 of 6");
        for wrong in ["", "3", "3/", "/3", "a/b", "0/3", "-1/3"] {
            assert!(wrong.parse::<Place>().is_err(), "{wrong}");
        }
    }
}
