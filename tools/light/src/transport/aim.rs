//! Where lamps must shine for their light to be focused: from which of them, and in which directions, paths come to a
//! surface by mirrors and glass alone.
//!
//! Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 5.2.2, projects the mirrors and glass onto a
//! hemisphere about each lamp; here paths of a pilot show them, so that what they lie behind is known as well. Half of all
//! paths are sent as if nothing were known: what the pilot missed is found too, and no photon has more than four times
//! the power that it would have without.

use super::directions::Directions;
use glam::Vec3;

/// Share of all paths for which a lamp is chosen by its power alone.
const POWER_SHARE: f64 = 0.5;

/// How likely each lamp is, and in which directions it sends paths.
pub(super) struct Aim {
    lamps: Vec<Lamp>,
}

struct Lamp {
    chance: f64,
    /// Sum of the chances up to and including this one.
    cumulative: f64,
    /// `None`: as the cosine.
    directions: Option<Directions>,
}

/// A path of the pilot that came to a surface by mirrors and glass alone.
pub(super) struct Focused {
    /// The lamp's number.
    pub(super) lamp: usize,
    /// Its normal.
    pub(super) normal: Vec3,
    /// In which direction the path left it.
    pub(super) direction: Vec3,
    /// What it brought, in watts times the number of paths.
    pub(super) power: f32,
}

impl Aim {
    /// From what the pilot found, and how likely each lamp is by its power.
    pub(super) fn new(by_power: impl Iterator<Item = f64>, found: &[Focused]) -> Self {
        let total: f64 = found.iter().map(|path| f64::from(path.power)).sum();
        let mut of_lamp: Vec<(f64, Vec<&Focused>)> = by_power.map(|chance| (chance, vec![])).collect();
        found.iter().for_each(|path| of_lamp[path.lamp].1.push(path));
        let mut cumulative = 0.0;
        let lamp = |(by_power, paths): (f64, Vec<&Focused>)| {
            let power: f64 = paths.iter().map(|path| f64::from(path.power)).sum();
            let chance =
                if total > 0.0 { POWER_SHARE * by_power + (1.0 - POWER_SHARE) * power / total } else { by_power };
            cumulative += chance;
            let light = paths.iter().map(|path| (path.direction, path.power));
            let directions = paths.first().and_then(|path| Directions::new(path.normal, light));
            Lamp { chance, cumulative, directions }
        };
        Self { lamps: of_lamp.into_iter().map(lamp).collect() }
    }

    /// The number of the lamp at `u` in [0, 1) of all chances, and its chance.
    pub(super) fn choose(&self, u: f32) -> (usize, f64) {
        let at = self.lamps.partition_point(|lamp| lamp.cumulative <= f64::from(u));
        // Rounding may leave the last sum below 1.
        let at = at.min(self.lamps.len() - 1);
        (at, self.lamps[at].chance)
    }

    /// How a lamp sends its paths, if not as the cosine.
    pub(super) fn directions(&self, lamp: usize) -> Option<&Directions> {
        self.lamps[lamp].directions.as_ref()
    }
}
