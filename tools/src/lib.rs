//! Photon maps, gather queries, their orders, and the caches they meet: the library behind the pm programs.
//!
//! `README.md` beside this crate is the map of the code and says which module may know which.

pub mod cache;
pub mod chart;
pub mod cli;
pub mod curve;
pub mod film;
pub mod foreign;
pub mod gather;
pub mod hemisphere;
pub mod image;
pub mod irradiance;
pub mod make_scene;
pub mod order;
pub mod page;
pub mod parallel;
pub mod photon_map;
pub mod random;
pub mod report;
pub mod scene;
pub mod setting;
pub mod size;
pub mod spool;
pub mod statistics;
pub mod transport;
pub mod view;
pub mod windows;
