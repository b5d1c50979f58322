//! Reverse photon mapping: the queries are indexed, and every photon looks for the queries that want it.
//!
//! Havran, Herzog and Seidel, *Fast Final Gathering via Reverse Photon Mapping*, Eurographics 2005. As many queries as the chip has
//! room for are a batch; its index stays on chip while the photons are read from memory, line after line, once for all of them. Of
//! each query the k best candidates so far are kept, on chip or in memory; the worst of them bounds the ball in which the query
//! wants photons. So the answers are those of every exact map, and the reads do not depend on the order of the queries, only on
//! how many there are. A photon lies where it lies in the stream, 20 bytes, none across a line.

mod query_index;

use super::error::check;
use super::{AccessObserver, BuildError, Nearest, PhotonMap};
use pm_formats::trace::{Coding, Region, Waits, lay_out};
use pm_formats::{Number, Photon};
use query_index::QueryIndex;

/// Region of the photons, in lines.
const PHOTONS: u16 = 0;
/// Region of the candidates, where they are kept in memory.
const CANDIDATES: u16 = 1;
/// Bytes of a candidate: squared distance and photon.
const CANDIDATE: u32 = 8;
/// Bytes of a query that waits on chip: its record, and the bound of its ball.
const WAITING: u64 = 44 + 4;

pm_registry::choices! {
    /// Where the candidates of the queries of a batch are kept.
    #[derive(Debug)]
    pub enum Candidates {
        /// On chip, 8 bytes each: k of them are far more than the query itself
        Chip = "chip",
        /// In memory, each query's in a heap: what is looked at of them is read, and would have to be written back as well
        Memory = "memory",
    }
}

/// Photons as they come, and how many queries are indexed at a time.
pub struct ReverseMap {
    positions: Vec<[f32; 3]>,
    line: u32,
    batch: usize,
    k: usize,
    candidates: Candidates,
}

impl ReverseMap {
    /// Takes the photons as they are, for searches of `k` in batches of so many queries, with candidates kept here or there.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(
        photons: &[Photon],
        line: u32,
        batch: usize,
        (k, candidates): (usize, Candidates),
    ) -> Result<Self, BuildError> {
        check(photons)?;
        BuildError::unless_fits(line, size_of::<Photon>() as u32)?;
        if candidates == Candidates::Memory && u32::try_from(batch.saturating_mul(k)).is_err() {
            return Err(BuildError::TooLarge);
        }
        let positions = photons.iter().map(|photon| photon.position).collect();
        Ok(Self { positions, line, batch, k, candidates })
    }

    /// Photons of a line.
    const fn in_line(&self) -> usize {
        self.line as usize / size_of::<Photon>()
    }

    /// Bytes that a batch takes on chip.
    #[must_use]
    pub const fn bytes_on_chip(&self) -> u64 {
        let candidates = match self.candidates {
            Candidates::Chip => self.k as u64 * CANDIDATE as u64,
            Candidates::Memory => 0,
        };
        self.batch as u64 * (WAITING + candidates)
    }
}

impl PhotonMap for ReverseMap {
    fn regions(&self, _: bool) -> Vec<Region> {
        let lines = self.positions.len().div_ceil(self.in_line()) as u64;
        let photons = ("photons".to_owned(), lines * u64::from(self.line), self.line, Coding::InTurns);
        let candidates = match self.candidates {
            Candidates::Chip => None,
            Candidates::Memory => {
                let bytes = (self.batch * self.k) as u64 * u64::from(CANDIDATE);
                Some(("candidates".to_owned(), bytes, CANDIDATE, Coding::InTurns))
            }
        };
        lay_out([photons].into_iter().chain(candidates))
    }

    fn len(&self) -> usize {
        self.positions.len()
    }

    fn tells_waits(&self) -> bool {
        // Lines are read one after the other, whatever is found; where candidates lie depends on what they hold.
        self.candidates == Candidates::Chip
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        vec![
            ("batch_queries", Number::Count(self.batch as u64)),
            ("batch_bytes_on_chip", Number::Bytes(self.bytes_on_chip())),
        ]
    }

    fn batch(&self) -> Option<usize> {
        Some(self.batch)
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        self.nearest_of_all(&[point], &mut [found], eyes);
    }

    fn nearest_of_all(&self, points: &[[f32; 3]], found: &mut [&mut Nearest], eyes: &mut impl AccessObserver) {
        let mut index = QueryIndex::new(points, found);
        for (line, positions) in (0..).zip(self.positions.chunks(self.in_line())) {
            eyes.read_after(PHOTONS, line, Waits::NOTHING);
            for (id, &position) in (line * self.in_line() as u32..).zip(positions) {
                let examined = index.offer(position, |query, distance| {
                    let base = query * self.k;
                    match self.candidates {
                        Candidates::Chip => found[query].show(distance, id),
                        Candidates::Memory => {
                            found[query].show_touching(distance, id, |slot| eyes.read(CANDIDATES, (base + slot) as u32))
                        }
                    }
                    found[query].bound()
                });
                eyes.examined(examined);
            }
        }
        // What was found is read once more, to be summed.
        if self.candidates == Candidates::Memory {
            for (query, found) in found.iter().enumerate() {
                (0..found.len()).for_each(|slot| eyes.read(CANDIDATES, (query * self.k + slot) as u32));
            }
        }
    }
}

#[cfg(test)]
mod tests;
