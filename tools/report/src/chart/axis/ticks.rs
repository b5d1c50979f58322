//! Where the ticks of an axis are, and what they say.

use super::{Axis, Scale};
use pm_size::Bytes;

impl Axis {
    /// Places of the ticks between two places, about `most` of them at most; of words, all.
    pub(in crate::chart) fn ticks(&self, low: f64, high: f64, most: u32) -> Vec<f64> {
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

    /// Places between the ticks of a logarithmic axis: of each decade 2 to 9, of powers of two all; none where they would be
    /// too many to be told apart.
    pub(in crate::chart) fn small_ticks(&self, low: f64, high: f64) -> Vec<f64> {
        let (first, last) = (low.floor() as i64, high.ceil() as i64);
        let places: Vec<f64> = match self.scale {
            Scale::Log10 if high - low <= 8.0 => (first..=last)
                .flat_map(|decade| (2..=9).map(move |digit| decade as f64 + f64::from(digit).log10()))
                .collect(),
            Scale::Log2 if high - low <= 40.0 => (first..=last).map(|power| power as f64).collect(),
            _ => vec![],
        };
        places.into_iter().filter(|place| (low..=high).contains(place)).collect()
    }

    /// What stands at a tick.
    pub(in crate::chart) fn tick_label(&self, place: f64) -> String {
        if !self.words.is_empty() {
            return self.words.get(place.round() as usize).cloned().unwrap_or_default();
        }
        let value = match self.scale {
            Scale::Log2 => place.exp2(),
            Scale::Log10 => 10.0_f64.powf(place),
            Scale::Linear | Scale::Auto => place,
        };
        match self.scale {
            Scale::Log2 if value >= 1.0 && (self.bytes || value >= 9999.5) => binary(value),
            Scale::Log2 => number(value),
            _ if self.bytes && value != 0.0 => number(value) + "B",
            _ => number(value),
        }
    }
}

/// A power of two as a tick says it: `64K`, by powers of 1024.
fn binary(value: f64) -> String {
    match value < 2.0_f64.powi(63) && value.log2().fract().abs() < 1e-9 {
        true => Bytes(value.round() as u64).to_string(),
        false => number(value),
    }
}

/// A number as a tick says it, by powers of 1000: `2.5M`, `0.002`, `1e-6`.
fn number(value: f64) -> String {
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
