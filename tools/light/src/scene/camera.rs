//! From where a scene is seen: a pinhole camera, and where its description comes from.

mod choice;
mod embree;
mod file;
mod find;
mod fit;
mod looks;
mod overrides;
mod pinhole;

pub use choice::CameraChoice;
pub use overrides::CameraOverrides;
pub use pinhole::Camera;
