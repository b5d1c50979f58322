//! Estimating irradiance at the sites.

use super::PrecomputationError;
use crate::{RadianceEstimate, Scratch, SearchCounts};
use pm_formats::{Material, Photon, pack_rgbe};
use pm_maps::{AnyMap, Nearest, Search, SearchReads};
use pm_random::Random;

/// What the random numbers that round irradiance are for: its own word, so that they are no others'.
const ROUNDING: u64 = 0x6972_7261_6469_616e;

/// How irradiance is computed beforehand.
pub struct Precomputation<'a> {
    /// The photons' map.
    pub map: &'a dyn AnyMap,
    /// How their nearest are searched for.
    pub search: Search,
    /// Do second touches of a record count as reads?
    pub reread: bool,
    /// The photons of the map.
    pub photons: &'a [Photon],
    /// What becomes of the photons found.
    pub estimate: &'a RadianceEstimate<'a>,
    /// One of how many photons is a site: those whose id is a multiple of it, whatever the order of queries.
    pub share: u32,
    /// Materials of the queries.
    pub materials: &'a [Material],
}

/// What is known of some sites.
pub(super) struct Chunk {
    /// Photon id and irradiance.
    pub(super) sites: Vec<(u32, [u8; 4])>,
    /// Of the largest disc of photons; infinite where there are fewer than k.
    pub(super) radius_squared: f32,
    pub(super) counts: SearchCounts,
}

impl Precomputation<'_> {
    /// The irradiance at these photons, where there is any to be had.
    pub(super) fn irradiance_at(&self, ids: &[u32]) -> Result<Chunk, PrecomputationError> {
        let (mut found, mut scratch) = (Nearest::new(self.search.k, 0.0), Scratch::default());
        let mut reads = SearchReads::with_rereads(self.reread);
        let mut counts = SearchCounts::default();
        let (mut sites, mut radius_squared) = (Vec::with_capacity(ids.len()), 0f32);
        for &id in ids {
            let photon = &self.photons[id as usize];
            reads.clear();
            counts.attempts += u64::from(self.search.run(self.map, photon.position, &mut found, &mut reads));
            counts.accesses += reads.len() as u64;
            counts.short += u64::from(!found.is_full());
            let farthest = found.farthest().filter(|_| found.is_full());
            radius_squared = radius_squared.max(farthest.map_or(f32::INFINITY, |(distance, _)| distance));
            match self.estimate.irradiance(photon.position, photon.normal(), &found, &mut scratch) {
                Some(irradiance) => {
                    // By a hash of the id, so that sums over many sites are exact on average.
                    let mut random = Random::new(&[ROUNDING, u64::from(id)]);
                    #[expect(clippy::cast_possible_truncation, reason = "what is too large becomes infinite")]
                    let packed = pack_rgbe(irradiance.map(|x| x as f32), [(); 3].map(|()| random.unit()));
                    sites.push((id, packed.ok_or(PrecomputationError::TooBright(id))?));
                }
                None => counts.no_area += 1,
            }
        }
        Ok(Chunk { sites, radius_squared, counts })
    }
}
