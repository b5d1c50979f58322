//! Cache sizes as they are asked for: `128K`, `4K..4M` for steps of two, `10%` of the map.

use pm_size::Bytes;
use std::str::FromStr;

/// A size, of a map that need not be known yet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Size {
    /// In bytes.
    Fixed(Bytes),
    /// A share of the lines that the map occupies.
    Share(f64),
}

impl Size {
    /// The number of lines, a multiple of `ways`, of a map that occupies so many; a size in bytes need be no number of lines.
    pub(super) fn bytes(self, line: u64, ways: u64, of_map: u64) -> u64 {
        match self {
            Self::Fixed(bytes) => bytes.0,
            Self::Share(share) => Self::lines(share, ways, of_map) * line,
        }
    }

    /// So many lines are a share of a map, in whole sets, at least one.
    fn lines(share: f64, ways: u64, of_map: u64) -> u64 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a count")]
        let lines = (share * of_map as f64) as u64;
        (lines / ways).max(1) * ways
    }
}

/// One size, or a range of sizes each twice the one before.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sizes(pub(super) Vec<Size>);

impl FromStr for Sizes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(percent) = text.strip_suffix('%') {
            let share = percent.parse().ok().filter(|&percent: &f64| percent > 0.0 && percent <= 100.0);
            let share = share.ok_or_else(|| format!("a share of the map goes from above 0% to 100%, not `{text}`"))?;
            return Ok(Self(vec![Size::Share(share / 100.0)]));
        }
        let size = |part: &str| part.parse::<Bytes>().map_err(|error| error.to_string());
        let Some((from, to)) = text.split_once("..") else { return Ok(Self(vec![Size::Fixed(size(text)?)])) };
        let (from, to) = (size(from)?, size(to)?);
        if from.0 == 0 || from > to {
            return Err(format!(
                "a range goes from a size above 0 to a larger one, as 4K..4M, not from {from} to {to}"
            ));
        }
        let doubled = std::iter::successors(Some(from.0), |size| size.checked_mul(2));
        Ok(Self(doubled.take_while(|&size| size <= to.0).map(|size| Size::Fixed(Bytes(size))).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_double() {
        let bytes = |size: &Size| size.bytes(128, 1, 0);
        let sizes = |text: &str| text.parse::<Sizes>().map(|sizes| sizes.0.iter().map(bytes).collect());
        assert_eq!(sizes("1K"), Ok(vec![1024]));
        assert_eq!(sizes("1K..1K"), Ok(vec![1024]));
        assert_eq!(sizes("3..25"), Ok(vec![3, 6, 12, 24]));
        assert_eq!(sizes("8E..15E"), Ok(vec![8 << 60]));
        assert!(sizes("0..1K").is_err_and(|message| message.contains("4K..4M")));
        assert!(sizes("2K..1K").is_err_and(|message| message.contains("from 2K to 1K")));
        assert!(sizes("1KB..1M").is_err_and(|message| message.contains("write 1K")));
    }

    #[test]
    fn shares_are_whole_sets_of_the_map() {
        let bytes = |text: &str, ways| text.parse::<Sizes>().map(|sizes| sizes.0[0].bytes(64, ways, 1000));
        assert_eq!(bytes("10%", 1), Ok(100 * 64));
        assert_eq!(bytes("10%", 8), Ok(96 * 64));
        assert_eq!(bytes("0.01%", 4), Ok(4 * 64));
        assert_eq!(bytes("100%", 1), Ok(1000 * 64));
        for wrong in ["0%", "101%", "nan%", "%", "x%"] {
            assert!(bytes(wrong, 1).is_err_and(|message| message.contains("100%")), "{wrong}");
        }
    }
}
