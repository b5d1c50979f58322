//! The header: what a stream is about and where it came from.

use crate::error::{Error, Result};
use crate::history::Step;
use crate::trace::Region;
use bincode::config::{Configuration, Fixint, Limit, LittleEndian};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

/// Largest header or end block that is read, in bytes; keeps a damaged length from claiming the memory.
pub(super) const MAX_RECORD: usize = 64 << 20;

/// What the records of a stream are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u16)]
pub enum StreamKind {
    /// Photons, 20 bytes each.
    Photons = 1,
    /// Gather queries, 44 bytes each.
    Queries = 2,
    /// Searches with the accesses they made.
    Trace = 3,
}

impl StreamKind {
    /// The kind with this number, if there is one.
    #[must_use]
    pub const fn from_number(number: u16) -> Option<Self> {
        match number {
            1 => Some(Self::Photons),
            2 => Some(Self::Queries),
            3 => Some(Self::Trace),
            _ => None,
        }
    }

    /// What the stream holds, in the plural, for people.
    #[must_use]
    pub const fn plural(self) -> &'static str {
        match self {
            Self::Photons => "photons",
            Self::Queries => "queries",
            Self::Trace => "searches (a trace)",
        }
    }
}

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

/// bincode with fixed-size little-endian integers and a limit: the one place that knows how headers are spelled.
const fn configuration() -> Configuration<LittleEndian, Fixint, Limit<MAX_RECORD>> {
    bincode::config::standard().with_little_endian().with_fixed_int_encoding().with_limit::<MAX_RECORD>()
}

pub(super) fn encode<T: Serialize>(value: &T) -> Result<Vec<u8>> {
    bincode::serde::encode_to_vec(value, configuration()).map_err(|error| Error::Invalid(error.to_string()))
}

/// Decodes a value that must fill `bytes` exactly.
pub(super) fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    match bincode::serde::decode_from_slice(bytes, configuration()) {
        Ok((value, used)) if used == bytes.len() => Some(value),
        _ => None,
    }
}
