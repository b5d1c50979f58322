//! The error of any recipe, by what was measured of some.

use crate::estimate::Estimate;
use crate::recipe::nth_design;
use crate::survey::{KS, LOTS, Layer, PILOT, Survey, seen_by};
use crate::{Recipe, Times};
use pm_sampling::Spread;

/// The square of the error of a run, in parts; their spreads are of what is not known, and of what differs from run to run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parts {
    /// Noise of eye, shadow and gather rays.
    pub rays: Estimate,
    /// Noise of photons, that no number of rays takes away.
    pub photons: Estimate,
    /// Blur.
    pub bias: Estimate,
}

impl Parts {
    /// The square of the error.
    #[must_use]
    pub fn total(&self) -> Estimate {
        self.rays.plus(self.photons).plus(self.bias)
    }
}

/// Predicts errors: what a survey found, corrected by what trials found.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// What was measured.
    pub survey: Survey,
    /// By what predicted noise is to be multiplied.
    pub noise: f64,
    /// By what the predicted square of the bias is to be multiplied.
    pub bias: f64,
}

impl Model {
    /// A model that nothing has corrected yet.
    #[must_use]
    pub const fn new(survey: Survey) -> Self {
        Self { survey, noise: 1.0, bias: 1.0 }
    }

    /// What recipes cost.
    #[must_use]
    pub const fn times(&self) -> &Times {
        &self.survey.times
    }

    /// What is to be saved: seconds of processor time; or bytes, and where these are the same, seconds.
    #[must_use]
    pub fn cost(&self, recipe: &Recipe, pixels: f64) -> f64 {
        let seconds = self.times().of(recipe, pixels);
        self.fetched(recipe, pixels).map_or(seconds, |bytes| bytes + BYTES_A_SECOND * seconds)
    }

    /// Bytes that a recipe fetches for so many pixels, where these are what is to be saved.
    #[must_use]
    pub fn fetched(&self, recipe: &Recipe, pixels: f64) -> Option<f64> {
        self.survey.traffic.as_ref().map(|traffic| traffic.of(recipe, pixels))
    }

    /// The same model where seconds are to be saved.
    #[must_use]
    pub fn by_time(&self) -> Self {
        let survey = Survey { traffic: None, ..self.survey.clone() };
        Self { survey, ..*self }
    }

    /// The square of the error of a recipe, whose neighbours, gather and shadow rays are among those measured.
    #[must_use]
    pub fn predict(&self, recipe: &Recipe) -> Parts {
        let Survey { soft, caustics, .. } = &self.survey;
        let k = nth(&KS, recipe.k).unwrap_or(0);
        let mut rays = self.rays(recipe, k);
        let mut photons = soft.photons[k].scaled(1.0 / recipe.photons as f64);
        let mut bias = soft.bias.at(recipe.share());
        if let (Some(layer), 1..) = (caustics, recipe.caustics) {
            rays = rays.plus(layer.rays[0].scaled(seen_by(recipe.samples)));
            photons = photons.plus(layer.photons[0].scaled(1.0 / recipe.caustics as f64));
            bias = bias.plus(layer.bias.at(f64::from(Times::CAUSTICS_K) / recipe.caustics as f64));
        }
        photons.spread = photons.spread.plus(self.lumps(recipe));
        let positive = |estimate: Estimate| Estimate { value: estimate.value.max(0.0), ..estimate };
        Parts {
            rays: positive(rays).scaled(self.noise),
            photons: positive(photons).scaled(self.noise),
            bias: bias.scaled(self.bias),
        }
    }

    /// Noise of eye, shadow and gather rays.
    fn rays(&self, recipe: &Recipe, k: usize) -> Estimate {
        let Survey { soft, rays, edges, .. } = &self.survey;
        let measured = rays[nth_design(recipe.gathers, recipe.light_samples)];
        let edges = edges.min(0.95 * measured.value);
        // The graininess of few neighbours, for each gather ray anew.
        let grain = (soft.rays[k].value - soft.rays[1].value) * f64::from(PILOT.gathers) / f64::from(recipe.gathers);
        let fewer = f64::from(PILOT.samples) / f64::from(recipe.samples);
        let plain = (measured.value - edges + grain).max(0.5 * (measured.value - edges));
        let value = plain * fewer + edges * fewer * libm::sqrt(fewer);
        let scale = if measured.value > 0.0 { value / measured.value } else { fewer };
        Estimate { value, spread: self.of_a_run(measured.spread).scaled(scale) }
    }

    /// How much the noise of photons differs from run to run.
    pub(crate) fn lumps(&self, recipe: &Recipe) -> Spread {
        let of = |layer: &Layer, k: usize, photons: u64| {
            let value = layer.photons[k].value / photons as f64;
            Spread { variance: value * value * layer.lumps[k], freedom: OF_LUMPS }
        };
        let soft = of(&self.survey.soft, nth(&KS, recipe.k).unwrap_or(0), recipe.photons);
        match &self.survey.caustics {
            Some(layer) if recipe.caustics > 0 => soft.plus(of(layer, 0, recipe.caustics)),
            _ => soft,
        }
    }

    /// The spread of a mean over the pixels that were looked at, and of that over all of them, which differ from run to run.
    fn of_a_run(&self, looked_at: Spread) -> Spread {
        Spread { variance: looked_at.variance * (1.0 + self.survey.share), ..looked_at }
    }
}

/// Bytes that are as dear as a second of processor time, where bytes are to be saved: a map that fits on the chip is not to be asked
/// without end. The paper's picture fetches 196 GB in some minutes.
const BYTES_A_SECOND: f64 = 1e8;
/// Degrees of freedom of what is known of lumps: those of as many maps as there are lots.
const OF_LUMPS: f64 = (2 * LOTS - 1) as f64;

fn nth(known: &[u32], wanted: u32) -> Option<usize> {
    known.iter().position(|&one| one == wanted)
}
