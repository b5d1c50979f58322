//! Estimating irradiance at the sites.

use super::PrecomputationError;
use crate::{RadianceEstimate, Scratch, SearchCounts};
use pm_formats::{Material, Photon, pack_rgbe};
use pm_maps::{AnyMap, Nearest, Search, SearchReads};
use pm_parallel::in_order;
use pm_random::Random;

/// Photons whose irradiance one thread estimates at a time.
pub(super) const CHUNK: usize = 1024;
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

/// What is known at a site.
pub(crate) struct Known {
    /// Of the photon there.
    pub(crate) id: u32,
    /// RGBE.
    pub(crate) irradiance: [u8; 4],
    /// The upper half of the squared distance, as a float, up to which it counts.
    pub(super) reach: u16,
}

impl Known {
    /// Squared distance up to which it counts.
    pub(crate) fn reach_squared(&self) -> f32 {
        f32::from_bits(u32::from(self.reach) << 16)
    }
}

/// What is known of all sites, and what it took.
#[derive(Default)]
pub(crate) struct Estimated {
    pub(crate) known: Vec<Known>,
    pub(crate) counts: SearchCounts,
    /// Sites that were asked for.
    pub(crate) searches: u64,
}

/// What is known of some sites.
struct Chunk {
    sites: Vec<Known>,
    counts: SearchCounts,
}

impl Precomputation<'_> {
    /// The irradiance at every `share`-th photon. Photons whose nearest all lie at one point say nothing and are left out.
    pub(crate) fn estimate(&self, threads: usize) -> Result<Estimated, PrecomputationError> {
        let ids: Vec<u32> = (0..).take(self.photons.len()).step_by(self.share as usize).collect();
        let mut all = Estimated { searches: ids.len() as u64, ..Estimated::default() };
        let mut chunks = ids.chunks(CHUNK);
        in_order(
            threads,
            || Ok(chunks.next()),
            |ids| self.irradiance_at(ids),
            |chunk| {
                let Chunk { sites, counts } = chunk?;
                all.known.extend(sites);
                all.counts += counts;
                Ok::<_, PrecomputationError>(())
            },
        )?;
        Ok(all)
    }

    /// The irradiance at these photons, where there is any to be had.
    fn irradiance_at(&self, ids: &[u32]) -> Result<Chunk, PrecomputationError> {
        let (mut found, mut scratch) = (Nearest::new(self.search.k, 0.0), Scratch::default());
        let mut reads = SearchReads::with_rereads(self.reread);
        let mut counts = SearchCounts::default();
        let mut sites = Vec::with_capacity(ids.len());
        for &id in ids {
            let photon = &self.photons[id as usize];
            reads.clear();
            counts.attempts += u64::from(self.search.run(self.map, photon.position, &mut found, &mut reads));
            counts.accesses += reads.len() as u64;
            counts.short += u64::from(!found.is_full());
            match self.estimate.irradiance(photon.position, photon.normal(), &found, &mut scratch) {
                Some((irradiance, reach)) => {
                    // By a hash of the id, so that sums over many sites are exact on average.
                    let mut random = Random::new(&[ROUNDING, u64::from(id)]);
                    #[expect(clippy::cast_possible_truncation, reason = "what is too large becomes infinite")]
                    let packed = pack_rgbe(irradiance.map(|x| x as f32), [(); 3].map(|()| random.unit()));
                    let irradiance = packed.ok_or(PrecomputationError::TooBright(id))?;
                    sites.push(Known { id, irradiance, reach: upper_half(reach * reach) });
                }
                None => counts.no_area += 1,
            }
        }
        Ok(Chunk { sites, counts })
    }
}

/// The upper half of a single-precision float not above `x`.
#[expect(clippy::cast_possible_truncation, reason = "16 bits are left; what is too large becomes infinite")]
fn upper_half(x: f64) -> u16 {
    ((x as f32).to_bits() >> 16) as u16
}
