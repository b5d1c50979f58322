//! Maps that do what no map may.

use super::rows::Row;
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};
use pm_maps::{AccessObserver, AnyMap, BruteForce, BuildError, Nearest, PhotonMap, Setting, Structure};

pm_registry::registered! {
    /// Gives up a little too early
    pub struct Hasty = "hasty";
}

pm_registry::registered! {
    /// Reads beyond its end
    pub struct Stray = "stray";
}

pm_registry::registered! {
    /// Takes any photon
    pub struct Careless = "careless";
}

impl Structure for Hasty {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        BruteForce::build(setting.photons)?;
        Ok(Box::new(Row::new(setting.photons, 0, 1e-3)))
    }
}

impl Structure for Careless {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        Ok(Box::new(Row::new(setting.photons, 0, 0.0)))
    }
}

impl Structure for Stray {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        Ok(Box::new(Beyond(BruteForce::build(setting.photons)?)))
    }
}

/// Brute force that numbers its records from 1.
struct Beyond(BruteForce);

/// Eyes that are told so.
struct FromOne<'a, E>(&'a mut E);

impl<E: AccessObserver> AccessObserver for FromOne<'_, E> {
    fn read(&mut self, region: u16, record: u32) {
        self.0.read(region, record + 1);
    }

    fn examined(&mut self, photons: usize) {
        self.0.examined(photons);
    }
}

impl PhotonMap for Beyond {
    fn regions(&self, _: bool) -> Vec<Region> {
        let record = size_of::<Photon>() as u32;
        lay_out([("photons".into(), PhotonMap::len(&self.0) as u64 * u64::from(record), record, Coding::Records)])
    }

    fn len(&self) -> usize {
        PhotonMap::len(&self.0)
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        self.0.nearest(point, found, &mut FromOne(eyes));
    }
}
