//! The header: what a stream is about and where it came from.

use crate::history::Step;
use crate::region::Region;
use serde::{Deserialize, Serialize};

/// An axis-aligned box in scene units. An empty box has `min > max`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// Least coordinates.
    pub min: [f32; 3],
    /// Greatest coordinates.
    pub max: [f32; 3],
}

/// How a surface reflects, as far as a radiance estimate needs to know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Name in the scene.
    pub name: String,
    /// Diffuse reflectance (albedo), linear RGB.
    pub diffuse: [f32; 3],
    /// Reflectance of the glossy lobe, linear RGB.
    pub specular: [f32; 3],
    /// Phong exponent of the glossy lobe.
    pub exponent: f32,
}

/// What a stream is about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Bounds of the scene.
    pub bounds: Bounds,
    /// Width and height of the image in pixels; `[0, 0]` where there is none.
    pub image: [u32; 2],
    /// Materials by id.
    pub materials: Vec<Material>,
    /// Number of records to come, where it is known: an upper bound, for progress only.
    pub expected_records: Option<u64>,
    /// What the records mean, as (name, value): `order`, `gathers` and the like.
    pub meaning: Vec<(String, String)>,
    /// Regions of the traced memory (traces only).
    pub regions: Vec<Region>,
    /// One step for each program that touched the stream, oldest first.
    pub history: Vec<Step>,
}

impl Header {
    /// A header that says nothing yet.
    #[must_use]
    pub fn empty() -> Self {
        Self {
            bounds: Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] },
            image: [0, 0],
            materials: vec![],
            expected_records: None,
            meaning: vec![],
            regions: vec![],
            history: vec![],
        }
    }

    /// Number of pixels of the image.
    #[must_use]
    pub const fn pixels(&self) -> u64 {
        self.image[0] as u64 * self.image[1] as u64
    }

    /// Says what the records mean; a name said before gets the new value.
    pub fn set_meaning(&mut self, name: &str, value: impl ToString) {
        self.meaning.retain(|(known, _)| known != name);
        self.meaning.push((name.to_owned(), value.to_string()));
    }

    /// What was said under this name.
    #[must_use]
    pub fn meaning(&self, name: &str) -> Option<&str> {
        self.meaning.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }
}
