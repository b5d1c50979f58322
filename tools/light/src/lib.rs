//! How light goes through a scene: what is rendered, where photons land, and where gather rays ask for them.

pub mod make_scene;
pub mod scene;
pub mod transport;
