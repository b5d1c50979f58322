//! Axes: where a value lies.

mod ticks;

pm_registry::choices! {
    /// How values are spread along an axis.
    #[derive(Debug, Default, serde::Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Scale {
        /// `log2` if all values are powers of two, and three of them differ; else `log10` if they span more than a factor of 20
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
            Scale::Auto if !positive => Scale::Linear,
            Scale::Auto if are_powers_of_two(values.clone()) => Scale::Log2,
            Scale::Auto if greatest < LOGARITHMIC_FROM * least => Scale::Linear,
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
}

/// Are positive values powers of two, three different ones at least? Two are soon so by chance.
fn are_powers_of_two(values: impl Iterator<Item = f64>) -> bool {
    let mut powers = std::collections::BTreeSet::new();
    for value in values {
        let power = value.log2();
        if power.fract() != 0.0 {
            return false;
        }
        powers.insert(power as i64);
    }
    powers.len() >= 3
}

/// The least and the greatest of some finite values; (1, 1) of none.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values
        .fold(None, |ends: Option<(f64, f64)>, x| Some(ends.map_or((x, x), |(a, b)| (a.min(x), b.max(x)))))
        .unwrap_or((1.0, 1.0))
}

#[cfg(test)]
mod tests;
