//! Photons that say for whom they count: each carries the radius of the k photons nearest to itself.
//!
//! Singh and Faloutsos, *SIMD Packet Techniques for Photon Mapping*, IEEE/EG Symposium on Interactive Ray Tracing, 2007: a
//! photon's radius is known when the map is built, so that a query asks which photons have it within *their* radius. It needs no
//! heap, no bound that shrinks and no second attempt. The estimate is another one, that of sample points: Silverman, *Density
//! Estimation for Statistics and Data Analysis*, 1986, section 2.6 (the variable kernel). Each photon spreads its flux over its own
//! disc, so that no light is lost or won, whatever k; what it spreads it moves, though: away from edges, and out of bright places.
//!
//! The photon is the first of its own k. Its disc is cut where its strangers show an edge, as a query's is; up to two
//! cuts are kept with it, which is what keeps its light from going through walls. A query that no photon reaches searches for
//! its own k, as where nothing is known of a surface.

mod disc;
mod tree;

use super::estimate::Spread;
use super::held_irradiance::HeldIrradiance;
use super::lobe::Lobe;
use super::precomputed::{Precomputation, PrecomputationError, packed};
use super::surface::{coarse, on_same_surface};
use super::{Kernel, Outcome, SearchCounts};
use disc::{LEAF, PhotonDisc};
use pm_formats::trace::{Coding, Region, lay_out};
use pm_formats::{Material, Number, Query, StageReport, unpack_direction};
use pm_maps::{AccessObserver, SearchReads};
use std::f64::consts::PI;
use tree::{Tree, in_leaves};

/// Codes of a photon's normal.
const CODES: u32 = 1 << 14;
/// What the random numbers that round flux per area are for.
const ROUNDING: u64 = 0x7068_6f74_6f6e_7261;
/// Bytes of a node and of a leaf: a line.
const LINE: u32 = 128;

/// Photons with radii of their own, in leaves of a line under a hierarchy of boxes.
pub struct PhotonRadii<'a> {
    /// Leaf after leaf.
    discs: Vec<PhotonDisc>,
    tree: Tree,
    /// By code, in steps of 1/127.
    normals: Box<[[i8; 3]]>,
    materials: &'a [Material],
    kernel: Kernel,
    k: usize,
    /// Number of the first of its regions in the trace.
    region: u16,
    built: SearchCounts,
    searches: u64,
}

impl<'a> PhotonRadii<'a> {
    /// Looks for the k nearest of each photon, and builds the hierarchy. Photons whose nearest all lie at one point light no
    /// area and are left out. The share of `how` is not asked for.
    ///
    /// # Errors
    /// See [`PrecomputationError`].
    pub fn new(how: &Precomputation<'a>, threads: usize) -> Result<Self, PrecomputationError> {
        let all = how.at_photons(1, threads, |id, photon, found, scratch| {
            let spread = how.estimate.spread(photon, found, disc::MOST_CUTS, scratch);
            spread
                .map(|Spread { radius, density, planes }| {
                    let density = packed(ROUNDING, id, density).ok_or(PrecomputationError::TooBright(id))?;
                    Ok(PhotonDisc::new(photon, radius, density, &planes))
                })
                .transpose()
        })?;
        let discs = in_leaves(all.known);
        Ok(Self {
            tree: Tree::over(&discs),
            discs,
            normals: (0..CODES).map(|code| coarse(unpack_direction::<7>(code))).collect(),
            materials: how.materials,
            kernel: how.estimate.kernel(),
            k: how.search.k,
            region: 0,
            built: all.counts,
            searches: all.searches,
        })
    }

    /// Calls `visit` with each disc whose ball holds a point, and its squared distance, in an order that is the structure's.
    fn reaching(&self, point: [f32; 3], eyes: &mut impl AccessObserver, mut visit: impl FnMut(&PhotonDisc, f32)) {
        self.tree.walk(point, self.region, eyes, |leaf| {
            let first = leaf as usize * LEAF;
            for disc in &self.discs[first..self.discs.len().min(first + LEAF)] {
                let distance = disc.distance_squared(point);
                if distance <= disc.radius * disc.radius {
                    visit(disc, distance);
                }
            }
        });
    }
}

impl HeldIrradiance for PhotonRadii<'_> {
    /// Photons tell where they came from: glossy surfaces are answered as well.
    fn serves(&self, _: &Query) -> bool {
        true
    }

    fn lay_out(&mut self, others: Vec<Region>) -> Vec<Region> {
        self.region = u16::try_from(others.len()).expect("a map has few regions");
        let others = others.into_iter().map(|it| (it.name, it.size, it.record_size, it.coding));
        let own = [("boxes", self.tree.nodes()), ("discs", self.discs.len().div_ceil(LEAF))];
        let own = own.map(|(name, lines)| (name.to_owned(), lines as u64 * u64::from(LINE), LINE, Coding::InTurns));
        lay_out(others.chain(own))
    }

    fn contribution(&self, query: &Query, reads: &mut SearchReads) -> Option<Outcome> {
        let normal = query.normal();
        let material = &self.materials[usize::from(query.material)];
        let diffuse = material.diffuse.map(|share| f64::from(share) / PI);
        let lobe = Lobe::of(material, query);
        let (mut sum, mut is_reached) = ([0.0; 3], false);
        self.reaching(query.position, reads, |disc, distance| {
            if !on_same_surface(self.normals[disc.code()], normal) || !disc.holds(query.position) {
                return;
            }
            is_reached = true;
            let weight = match self.kernel {
                Kernel::Constant => 1.0,
                kernel => kernel.weight(f64::from(distance).sqrt() / f64::from(disc.radius)),
            };
            let density = disc.density();
            let glossy = lobe.as_ref().map_or([0.0; 3], |lobe| lobe.brdf(disc.towards_source()));
            for channel in 0..3 {
                sum[channel] += weight * density[channel] * (diffuse[channel] + glossy[channel]);
            }
        });
        let weighted = || [0, 1, 2].map(|channel| f64::from(query.weight[channel]) * sum[channel]);
        is_reached.then(|| Outcome::Radiance(weighted()))
    }

    fn report(&self, stage: StageReport) -> StageReport {
        let lines = self.tree.nodes() + self.discs.len().div_ceil(LEAF);
        self.built
            .report_build(stage, self.searches)
            .with("precomputed_sites", Number::Count(self.discs.len() as u64))
            .with("precomputed_bytes", Number::Bytes(lines as u64 * u64::from(LINE)))
    }
}

impl std::fmt::Display for PhotonRadii<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "radii of photons, each of its own {} nearest", self.k)
    }
}

#[cfg(test)]
mod tests;
