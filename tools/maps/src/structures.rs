//! The structures of photon maps: a file each, and a line here.

mod block_hash;
mod brute;
mod bucket_kd;
mod grid;
mod grid_fixed;
mod kd;
mod kdb;
mod reverse;
mod treelets;
mod vvh;
mod wide;

use super::{Layout, Structure};
use pm_registry::{Domain, Parameter, Registry, words_of};

/// The structures that there are, of which the first is the usual one.
#[must_use]
pub fn structures() -> Registry<dyn Structure> {
    let structures: Registry<dyn Structure> = Registry::new(
        "map",
        &[
            &kd::Kd,
            &bucket_kd::BucketKd,
            &wide::Wide,
            &vvh::Vvh,
            &kdb::Kdb,
            &grid::Grid,
            &grid_fixed::GridFixed,
            &block_hash::BlockHash,
            &reverse::Reverse,
            &treelets::InTreelets,
            &brute::Brute,
        ],
    );
    structures.with_common(&[LINE])
}

/// The exact structure that answers soonest: for who wants answers, and not to know what they cost.
#[must_use]
pub fn fastest() -> &'static dyn Structure {
    &wide::Wide
}

/// Bytes of a line. Every structure takes them: what does not go by lines is still measured in them.
pub const LINE: Parameter = Parameter::new(
    "line",
    Domain::Count { least: 32, most: 65536, multiple_of: 4 },
    "bytes of a line (leaf, block, page, bucket)",
)
.called("BYTES")
.with_details("bucket-kd is fastest with 320: 16 photons.")
.or("128");

/// How the nodes of an implicit tree lie in memory.
const LAYOUT: Parameter = Parameter::new(
    "layout",
    Domain::Word(words_of::<Layout>),
    "where nodes lie in memory; changes the reads, not the answer",
)
.called("LAYOUT")
.or("heap");

/// Room in cells and buckets of fixed size; each structure says for what.
const SLOTS: Parameter = Parameter::new("slots", Domain::count(1, 1 << 20), "").hidden();
