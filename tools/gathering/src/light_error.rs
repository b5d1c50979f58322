//! How far the light of an approximate photon map is from that of an exact one: query by query, not pixel by pixel.

use super::Outcome;

/// What queries add to their pixels, by photons that were found and by those that were to be found, compared over all
/// three channels. A pixel is the sum of many queries, so that its own error is nearer to the bias.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightError {
    values: u64,
    found: f64,
    expected: f64,
    squares: f64,
}

impl LightError {
    /// Adds a query. Where nothing can be said it adds no light to the picture, nor here.
    pub fn add(&mut self, found: Outcome, expected: Outcome) {
        let radiance = |outcome| match outcome {
            Outcome::Radiance(radiance) => radiance,
            Outcome::NoArea => [0.0; 3],
        };
        for (found, expected) in radiance(found).into_iter().zip(radiance(expected)) {
            self.values += 1;
            self.found += found;
            self.expected += expected;
            self.squares += (found - expected) * (found - expected);
        }
    }

    /// Root of the mean squared difference, over the mean of what was to be found; NaN where that is dark.
    #[must_use]
    pub fn rms(&self) -> f64 {
        let values = self.values as f64;
        (self.squares / values).sqrt() / (self.expected / values)
    }

    /// Mean difference, over the mean of what was to be found: above 0 is too bright; NaN where that is dark.
    #[must_use]
    pub fn bias(&self) -> f64 {
        (self.found - self.expected) / self.expected
    }
}

#[cfg(test)]
mod tests;
