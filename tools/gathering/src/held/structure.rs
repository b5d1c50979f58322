//! What a structure of held irradiance is to those who choose one by its word.

use super::CellMap;
use pm_maps::{AnyMap, BuildError, KdTree, Layout, Setting, Structure};

/// Irradiance at a point of a surface, estimated beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// In scene units.
    pub position: [f32; 3],
    /// Unit normal.
    pub normal: [f32; 3],
    /// In watts per square scene unit, linear RGB.
    pub irradiance: [f64; 3],
    /// Distance up to which it tells of the same surface, in scene units.
    pub reach: f32,
}

/// A structure that holds irradiance, as it stands in a registry: a [`Structure`] whose photon map is there for glossy
/// surfaces, and for those of which it knows nothing.
pub trait IrradianceStructure: Structure {
    /// Holds these samples.
    fn hold(&self, samples: &[Sample]) -> Box<dyn CellMap>;

    /// What it is, in a word or two.
    fn name(&self) -> &'static str;
}

/// The photon map below all of them: the paper's.
///
/// # Errors
/// If the photons cannot be put into it.
pub(super) fn photon_map(setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
    Ok(Box::new(KdTree::build(setting.photons, Layout::Heap)?))
}
