//! What the pm programs share: how every one of them behaves, and the options that several take.
//!
//! `README.md` beside this crate's folder is the map of the code.

mod asked;
pub mod cachesim;
pub mod chart;
pub mod cli;
mod clock;
mod foreign_args;
pub mod gather;
pub mod photons;
pub mod picture;
mod pipe;
pub mod plan;
pub mod queries;
pub mod reorder;
pub mod scene;
pub mod setting;
pub mod sweep;
pub mod view;
