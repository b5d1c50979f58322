//! Scenes in formats that are not read, known by how they begin or are called.

use std::path::Path;

/// How files of a format begin.
const BEGINNINGS: &[(&[u8], &str)] = &[
    (b"glTF", "glTF"),
    (b"PXR-USDC", "USD"),
    (b"#usda", "USD"),
    (b"BLENDER", "a Blender file"),
    (b"Kaydara FBX Binary", "FBX"),
    (b"; FBX", "FBX"),
    (b"ply\n", "PLY"),
    (b"ply\r", "PLY"),
    (b"solid ", "STL"),
    (b"PK\x03\x04", "an archive"),
    (b"\x1f\x8b", "a compressed file"),
    (b"<?xml", "XML"),
];

/// How files of a format are called.
const ENDINGS: &[(&str, &str)] = &[
    ("gltf", "glTF"),
    ("glb", "glTF"),
    ("usd", "USD"),
    ("usda", "USD"),
    ("usdc", "USD"),
    ("usdz", "USD"),
    ("blend", "a Blender file"),
    ("fbx", "FBX"),
    ("dae", "COLLADA"),
    ("ply", "PLY"),
    ("stl", "STL"),
    ("3ds", "3DS"),
    ("pbrt", "pbrt"),
    ("mtl", "a material library"),
];

/// The format of a file that is no OBJ file, if it is known.
pub(super) fn format(path: &Path, bytes: &[u8]) -> Option<&'static str> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let by_ending = ENDINGS.iter().find(|(known, _)| ending.eq_ignore_ascii_case(known));
    let by_beginning = BEGINNINGS.iter().find(|(known, _)| bytes.starts_with(known));
    by_ending.map(|(_, format)| *format).or_else(|| by_beginning.map(|(_, format)| *format))
}
