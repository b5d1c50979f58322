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
}

impl GuidePhotons {
    /// Reads the photons that guide; remarks if they seem to be of another scene than that of these bounds.
    pub(super) fn read(path: &Path, bounds: &Bounds, common: &Common) -> anyhow::Result<Self> {
        let photons = cli::read_whole::<Photon>(path)?;
        let corners = |bounds: &Bounds| [Vec3::from(bounds.min), Vec3::from(bounds.max)];
        let ([min, max], [other_min, other_max]) = (corners(bounds), corners(&photons.header.bounds));
        let far = (max - min).length() * STRANGE;
        if !photons.records.is_empty() && (min.distance(other_min) > far || max.distance(other_max) > far) {
            let path = named(path);
            common.remark(format!("{path} is not of this scene: its bounds differ; what it guides wrongly is noisier"));
        }
        Ok(Self { path: path.to_owned(), photons })
    }

    /// Says in a header who guides, and in the history where from.
    pub(super) fn describe(&self, header: &mut Header, step: &mut Step) {
        let Self { path, photons: Whole { header: theirs, tally, .. } } = self;
        header.set_meaning(meaning::SAMPLING, "guided");
        header.set_meaning(meaning::GUIDE, format!("{} photons, digest {}", tally.records, tally.digest));
        step.inputs.push((path.display().to_string(), theirs.history.clone()));
    }

    /// Guides the rays; remarks if there is nothing to guide them by.
    pub(super) fn guide<'a>(self, rays: GatherRays<'a>, common: &Common) -> GatherRays<'a> {
        let rays = rays.guided_by(&self.photons.records);
        if rays.guiding_photons() == 0 {
            let none = self.photons.records.is_empty();
            let why = if none { "no photons" } else { "only photons straight from the lamps" };
            let path = named(&self.path);
            common.remark(format!("{path} holds {why}: nothing guides the gather rays, the cosine spreads them"));
        }
        rays
    }
}
