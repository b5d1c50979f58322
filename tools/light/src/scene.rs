//! What is rendered: triangles, what they are made of, and from where they are seen.
//!
//! OBJ and MTL files as exporters write them are read unedited; what cannot be meant is an error with file and line, what
//! is left out is a warning. Nothing here prints: [`Scene::warnings`] is for the program to show; and nothing opens a file:
//! bytes come from [`Files`]. The same files give the same scene, to the bit, on every machine.
//!
//! A module knows only modules above it:
//!
//! | modules | are about |
//! | --- | --- |
//! | `bounds`, `error`, `files`, `foreign`, `options`, `warnings` | what all others speak of |
//! | `mesh`, `polygon`, `material`, `triangles`, `light`, `quad_light`, `table` | scenes and their parts |
//! | `statements`, `mtl`, `libraries`, `obj`, `texture`, `ecs` | files, one by one |
//! | `meaning`, `builder`, `load` | what the files mean together |
//! | `camera` | from where a scene is seen |
//! | `digest` | what tells a scene from another |

mod bounds;
mod builder;
mod camera;
mod digest;
mod ecs;
mod error;
mod files;
mod foreign;
mod libraries;
mod light;
mod load;
mod material;
mod meaning;
mod mesh;
mod mtl;
mod obj;
mod options;
mod polygon;
mod quad_light;
mod statements;
mod table;
#[cfg(test)]
mod tests;
mod texture;
mod triangles;
mod warnings;

pub use bounds::Bounds;
pub use camera::{Camera, CameraChoice, CameraOverrides};
pub use error::{FileLine, SceneError};
pub use files::{FileSystem, Files};
pub use light::AreaLight;
pub use material::{Material, MaterialKind};
pub use mesh::Dropped;
pub use options::LoadOptions;
pub use quad_light::QuadLight;
pub use triangles::Scene;
