//! Cache sizes as they are asked for: `128K`, or `4K..4M` for steps of two.

use pm_size::Bytes;
use std::str::FromStr;

/// One size, or a range of sizes each twice the one before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Sizes(pub(super) Vec<Bytes>);

impl FromStr for Sizes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let size = |part: &str| part.parse::<Bytes>().map_err(|error| error.to_string());
        let Some((from, to)) = text.split_once("..") else { return Ok(Self(vec![size(text)?])) };
        let (from, to) = (size(from)?, size(to)?);
        if from.0 == 0 || from > to {
            return Err(format!(
                "a range goes from a size above 0 to a larger one, as 4K..4M, not from {from} to {to}"
            ));
        }
        let doubled = std::iter::successors(Some(from.0), |size| size.checked_mul(2));
        Ok(Self(doubled.take_while(|&size| size <= to.0).map(Bytes).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_double() {
        let sizes = |text: &str| text.parse::<Sizes>().map(|sizes| sizes.0.iter().map(|size| size.0).collect());
        assert_eq!(sizes("1K"), Ok(vec![1024]));
        assert_eq!(sizes("1K..1K"), Ok(vec![1024]));
        assert_eq!(sizes("3..25"), Ok(vec![3, 6, 12, 24]));
        assert_eq!(sizes("8E..15E"), Ok(vec![8 << 60]));
        assert!(sizes("0..1K").is_err_and(|message| message.contains("4K..4M")));
        assert!(sizes("2K..1K").is_err_and(|message| message.contains("from 2K to 1K")));
        assert!(sizes("1KB..1M").is_err_and(|message| message.contains("write 1K")));
    }
}
