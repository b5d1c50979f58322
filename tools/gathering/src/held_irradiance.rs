//! What is known beforehand, irradiance above all, as those see it who answer queries.

use super::Outcome;
use pm_formats::trace::Region;
use pm_formats::{Material, Query, StageReport};
use pm_maps::SearchReads;
use std::f64::consts::PI;

/// Irradiance that is held beforehand. It displays as what it is.
pub trait HeldIrradiance: std::fmt::Display + Sync {
    /// Is this query to be answered by what is held, if that knows its surface?
    fn serves(&self, query: &Query) -> bool;

    /// The regions of a trace: those of what is held come after the photon map's (`others`), which glossy surfaces read and
    /// those of which nothing is known.
    fn lay_out(&mut self, others: Vec<Region>) -> Vec<Region>;

    /// What `query` adds to its pixel; `None` if nothing is known of its surface.
    fn contribution(&self, query: &Query, reads: &mut SearchReads) -> Option<Outcome>;

    /// Adds what was done beforehand to a stage's report.
    fn report(&self, stage: StageReport) -> StageReport;
}

/// Is a surface of this material served? A glossy one wants to know where each photon came from, so that its queries go to
/// the photon map.
pub(super) fn is_diffuse(material: &Material) -> bool {
    material.specular.iter().all(|&share| share <= 0.0)
}

/// What irradiance at a query's point adds to its pixel: weight x albedo / pi x irradiance.
pub(super) fn reflected(query: &Query, material: &Material, irradiance: [f64; 3]) -> Outcome {
    Outcome::Radiance([0, 1, 2].map(|channel| {
        f64::from(query.weight[channel]) * (irradiance[channel] * (f64::from(material.diffuse[channel]) / PI))
    }))
}
