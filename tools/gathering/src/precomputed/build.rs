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

/// What is known of some photons, and what it took.
pub(crate) struct Estimated<T> {
    pub(crate) known: Vec<T>,
    pub(crate) counts: SearchCounts,
    /// Photons that were asked for.
    pub(crate) searches: u64,
}

impl Precomputation<'_> {
    /// The irradiance at every `share`-th photon. Photons whose nearest all lie at one point say nothing and are left out.
    pub(crate) fn estimate(&self, threads: usize) -> Result<Estimated<Known>, PrecomputationError> {
        self.at_photons(self.share, threads, |id, photon, found, scratch| {
            let known = self.estimate.irradiance(photon.position, photon.normal(), found, scratch);
            known
                .map(|(irradiance, reach)| {
                    let irradiance = packed(ROUNDING, id, irradiance).ok_or(PrecomputationError::TooBright(id))?;
                    Ok(Known { id, irradiance, reach: upper_half(reach * reach) })
                })
                .transpose()
        })
    }

    /// What `tell` makes of the nearest of every `share`-th photon; where it tells nothing they have no area.
    pub(crate) fn at_photons<T: Send>(
        &self,
        share: u32,
        threads: usize,
        tell: impl Fn(u32, &Photon, &Nearest, &mut Scratch) -> Result<Option<T>, PrecomputationError> + Sync,
    ) -> Result<Estimated<T>, PrecomputationError> {
        let ids: Vec<u32> = (0..).take(self.photons.len()).step_by(share as usize).collect();
        let mut all = Estimated { known: vec![], counts: SearchCounts::default(), searches: ids.len() as u64 };
        let mut chunks = ids.chunks(CHUNK);
        in_order(
            threads,
            || Ok(chunks.next()),
            |ids| self.at_some(ids, &tell),
            |chunk| {
                let (known, counts) = chunk?;
                all.known.extend(known);
                all.counts += counts;
                Ok::<_, PrecomputationError>(())
            },
        )?;
        Ok(all)
    }

    /// What `tell` makes of the nearest of these photons, and what it took.
    fn at_some<T>(
        &self,
        ids: &[u32],
        tell: &impl Fn(u32, &Photon, &Nearest, &mut Scratch) -> Result<Option<T>, PrecomputationError>,
    ) -> Result<(Vec<T>, SearchCounts), PrecomputationError> {
        let (mut found, mut scratch) = (Nearest::new(self.search.k, 0.0), Scratch::default());
        let mut reads = SearchReads::with_rereads(self.reread);
        let mut counts = SearchCounts::default();
        let mut known = Vec::with_capacity(ids.len());
        for &id in ids {
            let photon = &self.photons[id as usize];
            reads.clear();
            counts.attempts += u64::from(self.search.run(self.map, photon.position, &mut found, &mut reads));
            counts.accesses += reads.len() as u64;
            counts.short += u64::from(!found.is_full());
            match tell(id, photon, &found, &mut scratch)? {
                Some(told) => known.push(told),
                None => counts.no_area += 1,
            }
        }
        Ok((known, counts))
    }
}

/// Light as RGBE, rounded by a hash of `purpose` and of a photon's id, so that sums over many are exact on average; `None` if
/// it is beyond what that can say.
pub(crate) fn packed(purpose: u64, id: u32, light: [f64; 3]) -> Option<[u8; 4]> {
    let mut random = Random::new(&[purpose, u64::from(id)]);
    #[expect(clippy::cast_possible_truncation, reason = "what is too large becomes infinite")]
    pack_rgbe(light.map(|x| x as f32), [(); 3].map(|()| random.unit()))
}

/// The upper half of a single-precision float not above `x`.
#[expect(clippy::cast_possible_truncation, reason = "16 bits are left; what is too large becomes infinite")]
fn upper_half(x: f64) -> u16 {
    ((x as f32).to_bits() >> 16) as u16
}
