//! Do rays hit what they should, and is light neither lost nor made?

mod aimed;
mod at_specular;
mod direct;
mod eye;
mod glossy;
mod photons;
pub(super) mod pictures;
mod queries;
mod rays;
pub(super) mod scenes;
