//! Photon maps: who are the k nearest photons, and which memory does it take to find out?
//!
//! Every search is written once. It tells an [`AccessObserver`] which records it reads; an observer that does nothing
//! costs nothing, so the picture that is checked and the accesses that are counted come from the same code.
//!
//! ```
//! use pm_formats::Photon;
//! use pm_maps::{Nearest, Search, SearchReads, Setting, structures};
//!
//! // A row of photons on a floor, each of the same red power.
//! let up = [0.0, 1.0, 0.0];
//! let photons = (0..1000u16).map(|x| Photon::new([f32::from(x), 0.0, 0.0], [1.0, 0.0, 0.0], [0.5; 3], up, up).unwrap());
//! let photons: Vec<Photon> = photons.collect();
//!
//! // A map by its word, and what was said to it.
//! let chosen = structures().choose("bucket-kd --line 320").unwrap();
//! let map = chosen.entry.build(Setting { values: &chosen.values, photons: &photons, k: 10 })?;
//!
//! // The ten photons nearest to a point, and what it took to find them.
//! let (mut found, mut reads) = (Nearest::new(10, f32::INFINITY), SearchReads::default());
//! Search::new(10, f32::INFINITY).run(&*map, [500.2, 0.0, 0.0], &mut found, &mut reads);
//! let (farthest, id) = found.sorted()[9];
//! assert_eq!((id, farthest.sqrt().round()), (505, 5.0));
//! let red: f64 = found.iter().map(|(_, id)| photons[id as usize].power()[0]).sum();
//! assert!((red - 10.0).abs() < 0.1 && reads.len() < 20, "{red} {}", reads.len());
//! # Ok::<(), pm_maps::BuildError>(())
//! ```
//!
//! A structure is a file in `structures` that implements [`Structure`], and a line in [`structures`]; what it builds is a
//! [`PhotonMap`]. [`trial`] holds what every one must pass.

mod accuracy;
mod any_map;
mod block_hash;
mod brute_force;
mod bucket_kd;
mod candidates;
mod carry;
mod chosen_ids;
mod error;
pub mod geometry;
mod grid;
mod groups;
mod kd_tree;
mod kdb_tree;
mod layout;
mod nearest;
mod observer;
mod photon_blocks;
mod photon_map;
mod point;
mod reverse;
mod search;
mod search_reads;
mod select_nth;
mod split_tree;
mod start_radius;
mod structure;
mod structures;
mod treelets;
pub mod trial;
mod vicinity;
mod vvh;
mod waiting_reads;
mod wide;

pub use accuracy::Accuracy;
pub use any_map::AnyMap;
pub use block_hash::{BlockHash, BlockHashOptions, Orphans};
pub use brute_force::BruteForce;
pub use bucket_kd::BucketKdTree;
pub use carry::Carry;
pub use error::BuildError;
pub use grid::{Cells, Grid};
pub use groups::Groups;
pub use kd_tree::KdTree;
pub use kdb_tree::{KdbOptions, KdbTree, PageForm};
pub use layout::Layout;
pub use nearest::{Nearest, rank};
pub use observer::{AccessObserver, Blind};
pub use photon_map::{PhotonMap, offset_of};
pub use reverse::{Candidates, ReverseMap};
pub use search::Search;
pub use search_reads::SearchReads;
pub use start_radius::StartRadius;
pub use structure::{Setting, Structure};
pub use structures::{LINE, fastest, structures};
pub use treelets::{TreeletOptions, Treelets, Waiting};
pub use vicinity::{Ball, Vicinity};
pub use vvh::VvhTree;
pub use waiting_reads::WaitingReads;
pub use wide::{Instructions, WideTree};

#[cfg(test)]
mod stability;
#[cfg(test)]
mod tests;
