//! The photons that guide gather rays.

use crate::cli::{self, Common, Whole, named};
use glam::Vec3;
use pm_formats::vocabulary::meaning;
use pm_formats::{Bounds, Header, Photon, Step};
use pm_light::transport::GatherRays;
use std::path::{Path, PathBuf};

/// Share of the scene's diagonal by which the bounds of a guide's photons may differ from the scene's.
const STRANGE: f32 = 0.1;

/// A stream of photons, and its name.
pub(super) struct GuidePhotons {
    path: PathBuf,
    photons: Whole<Photon>,
    /// Do they seem to be of another scene?
    strange: bool,
}

impl GuidePhotons {
    /// Reads the photons that guide; remarks if they seem to be of another scene than that of these bounds.
    pub(super) fn read(path: &Path, bounds: &Bounds, common: &Common) -> anyhow::Result<Self> {
        let photons = cli::read_whole::<Photon>(path)?;
        let corners = |bounds: &Bounds| [Vec3::from(bounds.min), Vec3::from(bounds.max)];
        let ([min, max], [other_min, other_max]) = (corners(bounds), corners(&photons.header.bounds));
        let far = (max - min).length() * STRANGE;
        let strange = min.distance(other_min) > far || max.distance(other_max) > far;
        let strange = strange && !photons.records.is_empty();
        if strange {
            let path = named(path);
            common.remark(format!("{path} is not of this scene: its bounds differ; what it guides wrongly is noisier"));
        }
        Ok(Self { path: path.to_owned(), photons, strange })
    }

    /// Says in a header who guides, if they do, and in the history where from.
    pub(super) fn describe(&self, guided: bool, header: &mut Header, step: &mut Step) {
        let Self { path, photons: Whole { header: theirs, tally, .. }, .. } = self;
        if guided {
            header.set_meaning(meaning::SAMPLING, "guided");
            header.set_meaning(meaning::GUIDE, format!("{} photons, digest {}", tally.records, tally.digest));
        }
        step.inputs.push((path.display().to_string(), theirs.history.clone()));
    }

    /// Guides the rays; remarks if there is nothing to guide them by.
    pub(super) fn guide<'a>(&self, rays: GatherRays<'a>, common: &Common) -> GatherRays<'a> {
        let rays = rays.guided_by(&self.photons.records);
        if rays.guiding_photons() == 0 {
            let none = self.photons.records.is_empty();
            let why = if none { "no photons" } else { "only photons straight from the lamps" };
            let path = named(&self.path);
            common.remark(format!("{path} holds {why}: nothing guides the gather rays, the cosine spreads them"));
        }
        rays
    }

    /// Says that there are too few photons to guide anything, if that has not been said otherwise.
    pub(super) fn remark_too_few(&self, rays: &GatherRays<'_>, common: &Common) {
        if rays.guiding_photons() > 0 && !self.strange {
            let (path, number) = (named(&self.path), self.photons.records.len());
            common.remark(format!(
                "{path}: {number} photons are too few to guide: no quarter of the scene has {} on one side, so the cosine \
                 spreads the gather rays; 100,000 will do in most rooms",
                GatherRays::FEWEST_GUIDES
            ));
        }
    }
}
