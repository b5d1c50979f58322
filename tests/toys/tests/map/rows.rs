//! A map of one's own, all of it: photons in the order of one coordinate, searched to both sides.

use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};
use pm_maps::geometry::distance_squared;
use pm_maps::{AccessObserver, AnyMap, BruteForce, BuildError, Nearest, PhotonMap, Setting, Structure};
use pm_registry::{Domain, Parameter};

/// Along which axis.
const AXIS: Parameter = Parameter::new("axis", Domain::count(0, 2), "axis along which the photons are sorted").or("0");

pm_registry::registered! {
    /// Photons in a row, sorted by one coordinate
    pub struct Rows = "rows" with [AXIS];
}

impl Structure for Rows {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--axis 2"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        // It refuses what no map can take.
        BruteForce::build(setting.photons)?;
        Ok(Box::new(Row::new(setting.photons, setting.values.count(AXIS.name), 0.0)))
    }
}

/// The map. A search reads the photons beside the query's coordinate, and goes on to both sides as long as one may be near.
pub(crate) struct Row {
    axis: usize,
    sorted: Vec<(f32, u32, [f32; 3])>,
    /// How much nearer than it is each photon is taken to be along the axis: 0, but in a broken map.
    short_cut: f32,
}

impl Row {
    pub(crate) fn new(photons: &[Photon], axis: usize, short_cut: f32) -> Self {
        let photon = |(id, photon): (u32, &Photon)| (photon.position[axis], id, photon.position);
        let mut sorted: Vec<_> = (0..).zip(photons).map(photon).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Self { axis, sorted, short_cut }
    }
}

impl PhotonMap for Row {
    fn regions(&self, _: bool) -> Vec<Region> {
        let record = size_of::<Photon>() as u32;
        lay_out([("rows".into(), self.sorted.len() as u64 * u64::from(record), record, Coding::Records)])
    }

    fn len(&self) -> usize {
        self.sorted.len()
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        let at = point[self.axis];
        let middle = self.sorted.partition_point(|&(coordinate, ..)| coordinate < at);
        let mut sides = [
            (0..middle).rev().collect::<Vec<_>>().into_iter(),
            (middle..self.sorted.len()).collect::<Vec<_>>().into_iter(),
        ];
        for side in &mut sides {
            for record in side {
                let (coordinate, id, position) = self.sorted[record];
                eyes.read(0, record as u32);
                eyes.examined(1);
                // Rounded as the photon's own distance is, of which this is a part.
                let apart = coordinate - at;
                if apart * apart > found.bound() - self.short_cut {
                    break;
                }
                found.show(distance_squared(position, point), id);
            }
        }
    }
}
