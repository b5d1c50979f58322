//! Cell by cell as `cells`, but what falls into the cells that most queries lie in is answered as it is cast, and never waits.
//!
//! The hybrid hash join (DeWitt, Katz, Olken, Shapiro, Stonebraker, Wood, *Implementation Techniques for Main Memory Database
//! Systems*, SIGMOD 1984): queries are joined with photons, partition by partition; one partition is joined while the others
//! are written, because its photons are in the cache at that time. Which, a sample of 1 in 64 queries says, cast before.
//!
//! For the tiles of a picture, each a batch (`pm-queries --order tiled --tile 171 | pm-reorder hybrid --per batch`): the pixels of
//! a tile can be on chip until it is done, so that results cost little more than the finished picture. The map is gone through
//! once for each tile.
//!
//! On chip are, in bytes: 8 for each node of the tree of cells; 8 for each cell, its photons and its queries in the sample, in
//! whose place its cast is noted; a write buffer (256) for each cell that is resident in no cast, and one to read.
//! A query that waits is written once and read once. One that is resident is not; what it reads of the map is counted by the
//! cache, as with every order. With `--casts` all queries of a batch are cast so many times, nothing kept of them but by
//! the last cast, and other cells are resident each time: two rays for each query and cast but one, told as `rays_cast_again`.
//! Compact records count two rays for every query there, those answered at once included, which is more than they need.

mod join;

use super::parameters::{LEAF_PHOTONS, PHOTONS};
use super::residents::Residents;
use crate::{Order, Reorder, Setting, Store};
use join::Join;
use pm_registry::{Domain, Parameter, ParameterError, Values};

const RESIDENT: Parameter =
    Parameter::new("resident", Domain::count(0, u32::MAX as u64), "most photons of the cells that are resident")
        .or("2048");
const CASTS: Parameter =
    Parameter::new("casts", Domain::count(1, 1 << 16), "times that a batch is cast, other cells resident each time")
        .or("1");

pm_registry::registered! {
    /// As cells, but queries in the fullest cells are answered as they are cast, these cells being in the cache
    pub struct Hybrid = "hybrid" with [PHOTONS.needed(), LEAF_PHOTONS.or("2048"), RESIDENT, CASTS];
}

impl Order for Hybrid {
    fn label(&self, values: &Values, _: Store) -> String {
        let [leaf, resident, casts] = [LEAF_PHOTONS, RESIDENT, CASTS].map(|count| values.count::<u32>(count.name));
        format!("hybrid of {leaf} {resident}x{casts}")
    }

    fn forms(&self) -> &'static [&'static str] {
        &[
            "--photons map.pmp --leaf-photons 100 --resident 400",
            "--photons map.pmp --leaf-photons 50 --resident 300 --casts 3",
            "--photons map.pmp --resident 0",
        ]
    }

    fn build(&self, mut setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let photons = setting.photons.take().unwrap_or_default();
        let [leaf, resident, casts] = [LEAF_PHOTONS, RESIDENT, CASTS].map(|count| setting.values.count(count.name));
        let residents = Residents::new(photons, leaf, resident as u64, casts as u32);
        Ok(Box::new(Join::new(residents, setting.store, setting.limits)))
    }
}

#[cfg(test)]
mod tests;
