//! What is told of gathering in the end block of the trace.

use super::answering::Done;
use super::photons::Photons;
use crate::cli::Typed;
use pm_formats::vocabulary::measure;
use pm_formats::{Number, StageReport};
use pm_gathering::HeldIrradiance;
use pm_maps::{AnyMap, Search};

/// The stage of this program.
pub(super) fn stage(
    typed: &Typed,
    photons: &Photons,
    map: &dyn AnyMap,
    search: &Search,
    done: &Done,
    held: &dyn HeldIrradiance,
) -> StageReport {
    let counts = done.counts;
    let stage = StageReport::new(typed.program())
        .with("photons", Number::Count(photons.records.len() as u64))
        .with(measure::QUERIES, Number::Count(done.tally.records))
        .with(measure::ACCESSES, Number::Count(counts.accesses))
        .with(measure::ATTEMPTS, Number::Count(counts.attempts))
        .with("start_radius", Number::Real(f64::from(search.start)))
        .with(measure::SHORT_LOOKUPS, Number::Count(counts.short))
        .with(measure::LOOKUPS_WITHOUT_AREA, Number::Count(counts.no_area));
    let stage = map.measures().into_iter().fold(stage, |stage, (name, number)| stage.with(name, number));
    held.report(stage.with(measure::LOOKUPS_WITHOUT_SITE, Number::Count(counts.no_site)))
}
