//! The oracle: looks at every photon.

use super::error::check;
use super::geometry::distance_squared;
use super::{AccessObserver, BuildError, Nearest, PhotonMap};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, Waits, lay_out};

/// Photons in a row; a search reads them all.
pub struct BruteForce {
    positions: Vec<[f32; 3]>,
}

impl BruteForce {
    /// Takes the photons as they are.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon]) -> Result<Self, BuildError> {
        check(photons)?;
        Ok(Self { positions: photons.iter().map(|photon| photon.position).collect() })
    }
}

impl PhotonMap for BruteForce {
    fn regions(&self, _: bool) -> Vec<Region> {
        let bytes = self.positions.len() as u64 * size_of::<Photon>() as u64;
        lay_out([("photons".into(), bytes, size_of::<Photon>() as u32, Coding::Records)])
    }

    fn len(&self) -> usize {
        self.positions.len()
    }

    fn tells_waits(&self) -> bool {
        true
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        for (id, &position) in (0..).zip(&self.positions) {
            eyes.read_after(0, id, Waits::NOTHING);
            eyes.examined(1);
            found.show(distance_squared(point, position), id);
        }
    }
}
