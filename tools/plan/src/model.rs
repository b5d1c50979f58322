//! The error of any recipe, by what was measured of some.

use crate::estimate::Estimate;
use crate::survey::{KS, PILOT, RAYS, Survey, seen_by};
use crate::{Recipe, Times};

/// The square of an error, in parts.
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

    /// The square of the error of a recipe, whose neighbours, gather and shadow rays are among those measured.
    #[must_use]
    pub fn predict(&self, recipe: &Recipe) -> Parts {
        let Survey { soft, caustics, light, gathered, both, power, .. } = &self.survey;
        let k = KS.iter().position(|&k| k == recipe.k).unwrap_or(0);
        let number = |rays: u32| RAYS.iter().position(|&known| known == rays).unwrap_or(1);
        // The graininess of few neighbours, for each gather ray anew.
        let grain = (soft.rays[k].value - soft.rays[1].value) * f64::from(PILOT.gathers) / f64::from(recipe.gathers);
        let (light, gathered) = (light[number(recipe.light_samples)], gathered[number(recipe.gathers)]);
        let fewer = libm::pow(f64::from(PILOT.samples) / f64::from(recipe.samples), *power);
        let value =
            (light.value + gathered.value + 2.0 * both.value + grain).max(light.value.max(gathered.value) * 0.5);
        let spread = light.plus(gathered).spread;
        let mut rays = Estimate { value, spread }.scaled(fewer);
        let mut photons = soft.photons[k].scaled(1.0 / recipe.photons as f64);
        let mut bias = soft.bias.at(recipe.share());
        if let (Some(layer), 1..) = (caustics, recipe.caustics) {
            rays = rays.plus(layer.rays[0].scaled(seen_by(recipe.samples)));
            photons = photons.plus(layer.photons[0].scaled(1.0 / recipe.caustics as f64));
            bias = bias.plus(layer.bias.at(f64::from(Times::CAUSTICS_K) / recipe.caustics as f64));
        }
        let positive = |estimate: Estimate| Estimate { value: estimate.value.max(0.0), ..estimate };
        Parts {
            rays: positive(rays).scaled(self.noise),
            photons: positive(photons).scaled(self.noise),
            bias: bias.scaled(self.bias),
        }
    }
}
