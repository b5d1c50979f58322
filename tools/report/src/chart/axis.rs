//! Axes: where a value lies, where the ticks are, and what they say.

use pm_size::Bytes;

pm_registry::choices! {
    /// How values are spread along an axis.
    #[derive(Debug, Default, serde::Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Scale {
        /// `linear`, unless the values span more than a factor of 20: then `log2` if all are powers of two, else `log10`
        #[default]
        Auto = "auto",
        /// Equal differences, equal lengths
        Linear = "linear",
        /// Equal ratios, equal lengths; ticks at powers of two
        Log2 = "log2",
        /// Equal ratios, equal lengths; ticks at powers of ten
        Log10 = "log10",
    }
}

/// From this ratio of greatest to least value on, `auto` is logarithmic.
const LOGARITHMIC_FROM: f64 = 20.0;

/// One of the two axes of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What stands beside it.
    pub label: String,
    /// Never [`Scale::Auto`].
    pub(super) scale: Scale,
    /// The words along it, if it is of words and not of numbers.
    pub(super) words: Vec<String>,
    /// Do its numbers count bytes?
    pub(super) bytes: bool,
}

impl Axis {
    /// An axis for these values, all finite.
    ///
    /// # Errors
    /// If the scale is logarithmic and a value is not above zero: that value.
    pub(super) fn fit(
        label: &str,
        wanted: Scale,
        words: Vec<String>,
        values: impl Iterator<Item = f64> + Clone,
    ) -> Result<Self, f64> {
        let bytes = label.split(['_', ' ']).any(|word| matches!(word, "bytes" | "size" | "storage"));
        let positive = values.clone().all(|x| x > 0.0);
        let (least, greatest) = ends(values.clone());
        let scale = match wanted {
            _ if !words.is_empty() => Scale::Linear,
            Scale::Auto if !positive || greatest < LOGARITHMIC_FROM * least => Scale::Linear,
            Scale::Auto if values.clone().all(|x| x.log2().fract() == 0.0) => Scale::Log2,
            Scale::Auto => Scale::Log10,
            chosen => chosen,
        };
        if scale != Scale::Linear
            && let Some(low) = values.into_iter().find(|&x| x <= 0.0)
        {
            return Err(low);
        }
        Ok(Self { label: label.replace('_', " "), scale, words, bytes })
    }

    /// The words along it; none, if it is of numbers.
    pub(super) fn words(&self) -> &[String] {
        &self.words
    }

    /// Where a value lies: its place on the axis in the axis's own measure.
    pub(super) fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Log2 => value.log2(),
            Scale::Log10 => value.log10(),
            Scale::Linear | Scale::Auto => value,
        }
    }

    /// The ends of the axis for these values, a little beyond them, in places.
    pub(super) fn range(&self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        let (least, greatest) = ends(values.map(|value| self.place(value)));
        if !self.words.is_empty() {
            return (-0.5, self.words.len() as f64 - 0.5);
        }
        let margin = (greatest - least) * 0.04;
        match self.scale {
            // A linear axis begins at zero unless all of it lies far away from there.
            Scale::Linear if least >= 0.0 && least < 0.5 * greatest => (0.0, greatest + margin),
            _ if margin > 0.0 => (least - margin, greatest + margin),
            _ => (least - 0.5, greatest + 0.5),
        }
    }

    /// Places of the ticks between two places, about `most` of them at most; of words, all.
    pub(super) fn ticks(&self, low: f64, high: f64, most: u32) -> Vec<f64> {
        let most = f64::from(most.max(2));
        if !self.words.is_empty() {
            return (0..self.words.len()).map(|i| i as f64).collect();
        }
        let whole = |step: f64| {
            let first = (low / step).ceil() as i64;
            let last = (high / step).floor() as i64;
            (first..=last).map(|i| i as f64 * step).collect::<Vec<_>>()
        };
        match self.scale {
            Scale::Log10 if high - low < 2.0 => {
                // Less than two decades: also 2 and 5.
                let decades = (low.floor() as i64)..=(high.ceil() as i64);
                let places = decades.flat_map(|d| [1.0_f64, 2.0, 5.0].map(|m| d as f64 + m.log10()));
                places.filter(|place| (low..=high).contains(place)).collect()
            }
            Scale::Log2 | Scale::Log10 => whole(((high - low) / most).ceil().max(1.0)),
            Scale::Linear | Scale::Auto => {
                let raw = (high - low) / most * 1.3;
                let power = 10.0_f64.powf(raw.log10().floor());
                let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| m * power >= raw).unwrap_or(10.0) * power;
                whole(step)
            }
        }
    }

    /// What stands at a tick.
    pub(super) fn tick_label(&self, place: f64) -> String {
        if !self.words.is_empty() {
            return self.words.get(place.round() as usize).cloned().unwrap_or_default();
        }
        let value = match self.scale {
            Scale::Log2 => place.exp2(),
            Scale::Log10 => 10.0_f64.powf(place),
            Scale::Linear | Scale::Auto => place,
        };
        number(value, self.bytes)
    }
}

/// The least and the greatest of some finite values; (1, 1) of none.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values
        .fold(None, |ends: Option<(f64, f64)>, x| Some(ends.map_or((x, x), |(a, b)| (a.min(x), b.max(x)))))
        .unwrap_or((1.0, 1.0))
}

/// A number as a tick says it: `64K` if it is a round number of bytes, else `2.5M`, `0.002`, `1e-6`.
fn number(value: f64, bytes: bool) -> String {
    if bytes && value >= 1.0 && value < 2.0_f64.powi(63) && value.log2().fract().abs() < 1e-9 {
        return Bytes(value.round() as u64).to_string();
    }
    // Three digits; what is left of the arithmetic that found the tick goes with the rest.
    let short = |x: f64| {
        let rounded: f64 = format!("{x:.2e}").parse().unwrap_or(x);
        rounded.to_string()
    };
    let size = value.abs();
    match size {
        _ if size < 1e-12 => "0".to_owned(),
        // Lines of 1024 bytes are no 1020.
        _ if size < 9999.5 && (value - value.round()).abs() < 1e-9 * size => value.round().to_string(),
        _ if !(1e-4..1e15).contains(&size) => format!("{value:.0e}"),
        _ if size >= 0.9995e12 => short(value / 1e12) + "T",
        _ if size >= 0.9995e9 => short(value / 1e9) + "G",
        _ if size >= 0.9995e6 => short(value / 1e6) + "M",
        _ if size >= 0.9995e4 => short(value / 1e3) + "k",
        _ => short(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(label: &str, values: &[f64]) -> Axis {
        Axis::fit(label, Scale::Auto, vec![], values.iter().copied()).expect("an axis")
    }

    #[test]
    fn the_scale_follows_the_values() {
        assert_eq!(axis("ways", &[1.0, 2.0, 16.0]).scale, Scale::Linear);
        assert_eq!(axis("size", &[1024.0, 4096.0, 1_048_576.0]).scale, Scale::Log2);
        assert_eq!(axis("fetches", &[0.03, 71.0]).scale, Scale::Log10);
        assert_eq!(axis("fetches", &[0.0, 71.0]).scale, Scale::Linear);
        let refused = Axis::fit("n", Scale::Log10, vec![], [3.0, 0.0].into_iter());
        assert_eq!(refused, Err(0.0));
    }

    #[test]
    fn ticks_are_round_and_within() {
        for (values, scale, expected) in [
            (vec![0.0, 100.0], Scale::Linear, "0 20 40 60 80 100"),
            (vec![4096.0, 131_072.0], Scale::Log2, "4K 8K 16K 32K 64K 128K"),
            (vec![0.5, 2e6], Scale::Log10, "1 10 100 1000 10k 100k 1M"),
            (vec![12.0, 80.0], Scale::Log10, "20 50"),
            (vec![1e6, 1.1e6], Scale::Linear, "1M 1.02M 1.04M 1.06M 1.08M 1.1M"),
        ] {
            let label = if scale == Scale::Log2 { "size" } else { "n" };
            let axis = Axis::fit(label, scale, vec![], values.iter().copied()).expect("an axis");
            let (low, high) = axis.range(values.iter().copied());
            let ticks = axis.ticks(low, high, 10);
            assert!(ticks.iter().all(|tick| (low..=high).contains(tick)));
            let labels: Vec<String> = ticks.iter().map(|&tick| axis.tick_label(tick)).collect();
            assert_eq!(labels.join(" "), expected, "{values:?} {scale:?}");
        }
    }

    #[test]
    fn whole_numbers_keep_all_their_digits() {
        let lines = [32.0, 1024.0];
        let axis = Axis::fit("line", Scale::Log2, vec![], lines.into_iter()).expect("an axis");
        let labels: Vec<String> = axis.ticks(5.0, 10.0, 10).iter().map(|&tick| axis.tick_label(tick)).collect();
        assert_eq!(labels.join(" "), "32 64 128 256 512 1024");
    }

    #[test]
    fn all_values_lie_within_the_range_even_if_there_is_but_one() {
        for values in [vec![5.0], vec![0.0], vec![-3.0, -1.0], vec![1e-9, 1e12]] {
            let axis = axis("n", &values);
            let (low, high) = axis.range(values.iter().copied());
            assert!(low < high && values.iter().all(|&x| (low..=high).contains(&axis.place(x))), "{values:?}");
        }
    }

    #[test]
    fn words_stand_at_whole_numbers() {
        let axis = Axis::fit("ways", Scale::Auto, vec!["1".into(), "full".into()], [0.0, 1.0].into_iter()).unwrap();
        let (low, high) = axis.range([0.0, 1.0].into_iter());
        let labels: Vec<String> = axis.ticks(low, high, 10).into_iter().map(|place| axis.tick_label(place)).collect();
        assert_eq!(labels, ["1", "full"]);
    }
}
