//! Irradiance in cells of one structure or another, looked up at queries.

use super::{CellMap, Footprint, IrradianceStructure, Place, Sample};
use crate::held_irradiance::{HeldIrradiance, is_diffuse, reflected};
use crate::precomputed::{Precomputation, PrecomputationError};
use crate::{Outcome, SearchCounts};
use pm_formats::trace::{Region, lay_out};
use pm_formats::{Material, Number, Query, StageReport, unpack_rgbe};
use pm_maps::SearchReads;

/// Irradiance estimated at photons, held in cells.
pub struct IrradianceCells<'a> {
    cells: Box<dyn CellMap>,
    /// What they are.
    name: &'static str,
    footprint: Footprint,
    materials: &'a [Material],
    share: u32,
    /// Number of the first of its regions in the trace.
    region: u16,
    built: SearchCounts,
    searches: u64,
    samples: u64,
}

impl<'a> IrradianceCells<'a> {
    /// Estimates the irradiance at some of the photons, and holds it in a structure.
    ///
    /// # Errors
    /// See [`PrecomputationError`].
    pub fn new(
        how: &Precomputation<'a>,
        structure: &dyn IrradianceStructure,
        footprint: Footprint,
        threads: usize,
    ) -> Result<Self, PrecomputationError> {
        let all = how.estimate(threads)?;
        let samples: Vec<Sample> = all
            .known
            .iter()
            .map(|known| {
                let photon = &how.photons[known.id as usize];
                let (normal, irradiance) = (photon.normal(), unpack_rgbe(known.irradiance));
                Sample { position: photon.position, normal, irradiance, reach: known.reach_squared().sqrt() }
            })
            .collect();
        Ok(Self {
            cells: structure.hold(&samples),
            name: structure.name(),
            footprint,
            materials: how.materials,
            share: how.share,
            region: 0,
            built: all.counts,
            searches: all.searches,
            samples: samples.len() as u64,
        })
    }
}

impl HeldIrradiance for IrradianceCells<'_> {
    fn serves(&self, query: &Query) -> bool {
        is_diffuse(&self.materials[usize::from(query.material)])
    }

    fn lay_out(&mut self, others: Vec<Region>) -> Vec<Region> {
        self.region = u16::try_from(others.len()).expect("a map has few regions");
        let others = others.into_iter().map(|it| (it.name, it.size, it.record_size, it.coding));
        lay_out(others.chain(self.cells.regions()))
    }

    fn contribution(&self, query: &Query, reads: &mut SearchReads) -> Option<Outcome> {
        let footprint = self.footprint.width(query);
        let place = Place { point: query.position, normal: query.normal(), footprint };
        let irradiance = self.cells.find(&place, self.region, reads)?;
        Some(reflected(query, &self.materials[usize::from(query.material)], irradiance))
    }

    fn report(&self, stage: StageReport) -> StageReport {
        let bytes = self.cells.regions().iter().map(|(_, bytes, ..)| bytes).sum();
        let stage = self
            .built
            .report_build(stage, self.searches)
            .with("precomputed_sites", Number::Count(self.samples))
            .with("precomputed_bytes", Number::Bytes(bytes));
        self.cells.measures().into_iter().fold(stage, |stage, (name, number)| stage.with(name, number))
    }
}

impl std::fmt::Display for IrradianceCells<'_> {
    /// How many photons are samples, and what holds them.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "irradiance at 1 of {} photons, in {}, {}", self.share, self.name, self.footprint)
    }
}
