//! Photons of many paths, collected until there are enough.

use anyhow::bail;
use pm_formats::{BLOCK_RECORDS, Photon, UnroundedPhoton};
use pm_light::transport::{PathPhoton, PhotonPaths};
use std::ops::Range;

/// Photons of consecutive paths, and after how many photons each path ends.
pub(super) struct Traced {
    photons: Vec<PathPhoton>,
    path_ends: Vec<usize>,
}

impl Traced {
    /// Traces paths.
    pub(super) fn paths(paths: &PhotonPaths<'_>, numbers: Range<u64>) -> Self {
        let mut traced = Self { photons: vec![], path_ends: vec![] };
        for path in numbers {
            paths.trace(path, |photon| traced.photons.push(photon));
            traced.path_ends.push(traced.photons.len());
        }
        traced
    }

    /// How many photons each path stores.
    pub(super) fn path_sizes(&self) -> impl Iterator<Item = u64> + '_ {
        let begins = std::iter::once(0).chain(self.path_ends.iter().copied());
        self.path_ends.iter().zip(begins).map(|(end, begin)| (end - begin) as u64)
    }

    /// The photons, for a part of a stream.
    pub(super) fn unrounded(&self) -> impl Iterator<Item = UnroundedPhoton> + '_ {
        let path_of = (0u32..).zip(self.path_sizes()).flat_map(|(path, n)| std::iter::repeat_n(path, n as usize));
        self.photons.iter().zip(path_of).map(|(photon, path)| {
            let (position, power) = (photon.position.into(), photon.power.into());
            UnroundedPhoton::new(position, power, photon.towards_source.into(), photon.normal.into(), path)
        })
    }
}

/// What has been collected so far.
pub(super) struct Collected {
    wanted: u64,
    /// Photons stored.
    pub(super) stored: u64,
    /// Paths that they are of, with those that stored none.
    pub(super) emitted: u64,
    packed: Vec<Photon>,
}

impl Collected {
    /// Nothing, of at least so many photons.
    pub(super) fn new(wanted: u64) -> Self {
        Self { wanted, stored: 0, emitted: 0, packed: Vec::with_capacity(BLOCK_RECORDS) }
    }

    /// Are there as many as are wanted?
    pub(super) const fn is_complete(&self) -> bool {
        self.stored >= self.wanted
    }

    /// Adds whole paths until there are enough, and gives their photons; work done ahead of the path that completes the
    /// number is dropped.
    pub(super) fn add(&mut self, traced: &Traced, paths: &PhotonPaths<'_>) -> anyhow::Result<&[Photon]> {
        let mut from = 0;
        self.packed.clear();
        for &end in &traced.path_ends {
            if self.is_complete() {
                break;
            }
            for photon in &traced.photons[from..end] {
                let id = self.stored;
                let Some(photon) = paths.pack(id, photon) else {
                    bail!("the power of photon {id} is beyond what a photon can hold; is the light's Ke right?");
                };
                self.packed.push(photon);
                self.stored += 1;
            }
            from = end;
            self.emitted += 1;
        }
        Ok(&self.packed)
    }
}
