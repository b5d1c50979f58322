//! Scenes as a whole: does what users bring load, does what cannot work say why, and are the shipped scenes right?

mod anything;
mod faces;
mod libraries;
mod shipped;
mod support;
mod whole;
