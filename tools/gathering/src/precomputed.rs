//! Precomputed irradiance: estimated once at every few photons, then looked up by one nearest-neighbour search.
//!
//! Christensen, *Faster Photon Map Global Illumination*, Journal of Graphics Tools 4(3), 1999: a diffuse surface asks for
//! irradiance only, irradiance changes slowly, and a final gather does not look at it closely. So the query takes the
//! irradiance of the nearest photon with a similar normal.
//!
//! The photon at a site is one of its own k, and that is right: points of a picture take the nearest site, around which
//! there is less than elsewhere, on average by just that one photon (no other site is nearer to the point). This holds as
//! long as the photons' discs are large beside the distances to sites, k beside 4 times the photons to a site; k = 10 with
//! one site in four is 4 % too bright.
//!
//! A site counts only where it knows something: well within its photons' disc, nearer than the nearest edge that they show, and
//! near the tangent plane of the point that asks. Without the first two a sealed dark room is lit by the sites of the room
//! beyond its wall, and a room behind a gap by those before it. Where no site counts, the point searches for itself.

mod build;
mod search;

use super::held_irradiance::{HeldIrradiance, is_diffuse, reflected};
use super::{Outcome, SearchCounts};
pub use build::Precomputation;
pub(crate) use build::packed;
use build::{Estimated, Known};
use pm_formats::trace::{Coding, Region, lay_out};
use pm_formats::{Material, Number, Photon, Query, StageReport, unpack_direction, unpack_rgbe};
use pm_maps::{AccessObserver, BuildError, KdTree, Layout, SearchReads};

/// Where irradiance was computed: the 20 bytes of a node in the traced memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
struct Site {
    /// Of the photon, in scene units.
    position: [f32; 3],
    /// In watts per square scene unit, RGBE.
    irradiance: [u8; 4],
    /// Of the photon's surface, octahedral, 7 bits a coordinate, above the split axis.
    normal_axis: u16,
    /// The upper half of a float: the squared distance up to which it counts, in square scene units.
    reach: u16,
}

const _: () = assert!(size_of::<Site>() == 20);

impl Site {
    /// Squared distance up to which it counts.
    #[inline]
    fn reach_squared(&self) -> f32 {
        f32::from_bits(u32::from(self.reach) << 16)
    }

    fn normal(&self) -> [f32; 3] {
        unpack_direction::<7>(u32::from(self.normal_axis >> 2))
    }

    fn axis(&self) -> usize {
        usize::from(self.normal_axis & 3)
    }
}

/// Why irradiance cannot be computed beforehand.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum PrecomputationError {
    /// The sites cannot be put into a tree.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// Irradiance beyond 2^127.
    #[error("the irradiance at photon {0} is beyond what 4 bytes can say (2^127); was the scene scaled wrongly?")]
    TooBright(u32),
}

/// Irradiance at photons, in a left-balanced kd-tree of its own.
pub struct PrecomputedIrradiance<'a> {
    /// Node i at index i - 1.
    sites: Vec<Site>,
    /// Photon id of each: who comes first of equally near ones. Not in the traced memory, like the ids of other maps.
    ids: Vec<u32>,
    materials: &'a [Material],
    share: u32,
    /// Largest squared distance at which any site counts.
    bound: f32,
    /// Number of its region in the trace.
    region: u16,
    built: SearchCounts,
    searches: u64,
}

impl<'a> PrecomputedIrradiance<'a> {
    /// Estimates the irradiance at every `share`-th photon from the k photons nearest to it, and builds the tree. Photons
    /// whose nearest all lie at one point say nothing and are no sites.
    ///
    /// # Errors
    /// See [`PrecomputationError`].
    pub fn new(how: &Precomputation<'a>, threads: usize) -> Result<Self, PrecomputationError> {
        let Estimated { known, counts: built, searches } = how.estimate(threads)?;
        let chosen: Vec<Photon> = known.iter().map(|site| how.photons[site.id as usize]).collect();
        let tree = KdTree::build(&chosen, Layout::Heap)?;
        let nodes = || tree.nodes().map(|(axis, at)| (axis as u16, at as usize));
        let site = |(axis, at): (u16, usize)| {
            let photon: &Photon = &chosen[at];
            let Known { irradiance, reach, .. } = known[at];
            Site { position: photon.position, irradiance, normal_axis: photon.flags & !3 | axis, reach }
        };
        let sites: Vec<Site> = nodes().map(site).collect();
        Ok(Self {
            bound: sites.iter().map(Site::reach_squared).fold(0.0, f32::max),
            sites,
            ids: nodes().map(|(_, at)| known[at].id).collect(),
            materials: how.materials,
            share: how.share,
            region: 0,
            built,
            searches,
        })
    }

    /// What `query` adds to its pixel: that of the irradiance of the nearest site that knows of its surface; `None` if there is
    /// none.
    fn nearest_contribution(&self, query: &Query, eyes: &mut impl AccessObserver) -> Option<Outcome> {
        let site = self.nearest(query.position, query.normal(), eyes)?;
        let irradiance = unpack_rgbe(self.sites[site].irradiance);
        Some(reflected(query, &self.materials[usize::from(query.material)], irradiance))
    }
}

impl HeldIrradiance for PrecomputedIrradiance<'_> {
    fn serves(&self, query: &Query) -> bool {
        is_diffuse(&self.materials[usize::from(query.material)])
    }

    fn lay_out(&mut self, others: Vec<Region>) -> Vec<Region> {
        self.region = u16::try_from(others.len()).expect("a map has few regions");
        let nodes = u32::try_from(self.sites.len()).expect("no more than photons");
        let record = size_of::<Site>() as u32;
        // A node's own site is looked at as it is reached: there are no second touches.
        let coding = Coding::HeapWalk { nodes, reread: false };
        let own = ("precomputed".to_owned(), u64::from(nodes) * u64::from(record), record, coding);
        lay_out(others.into_iter().map(|it| (it.name, it.size, it.record_size, it.coding)).chain([own]))
    }

    fn contribution(&self, query: &Query, reads: &mut SearchReads) -> Option<Outcome> {
        self.nearest_contribution(query, reads)
    }

    fn report(&self, stage: StageReport) -> StageReport {
        self.built
            .report_build(stage, self.searches)
            .with("precomputed_sites", Number::Count(self.sites.len() as u64))
            .with("precomputed_bytes", Number::Bytes(size_of_val(&self.sites[..]) as u64))
    }
}

impl std::fmt::Display for PrecomputedIrradiance<'_> {
    /// How many photons are sites.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "irradiance at 1 of {} photons", self.share)
    }
}

#[cfg(test)]
mod tests;
