//! Gathers the ten photons nearest to a point, and their flux.

use pm_formats::Photon;
use pm_maps::{BucketKdTree, Layout, Nearest, Search, SearchReads};
use std::io::{self, Write as _};

/// What is found: the photons with their distances, nearest first; their flux; and the records that were read.
pub struct Gathered {
    /// Distance and id of each.
    pub nearest: Vec<(f32, u32)>,
    /// Linear RGB.
    pub flux: [f64; 3],
    /// Records of the map that were read.
    pub reads: usize,
}

/// Ten neighbours of the middle of a square floor on which photons lie in rows, redder to the right.
pub fn gather() -> Result<Gathered, pm_maps::BuildError> {
    let up = [0.0, 1.0, 0.0];
    let photon = |x: u8, z: u8| {
        let (x, z) = (f32::from(x) / 100.0, f32::from(z) / 100.0);
        Photon::new([x, 0.0, z], [1.0 + x, 1.0, 1.0], [0.5; 3], up, up).expect("a plain photon")
    };
    let photons: Vec<Photon> = (0..=100).flat_map(|x| (0..=100).map(move |z| photon(x, z))).collect();

    // Leaves of 16 photons. Any other map finds the same.
    let map = BucketKdTree::build(&photons, Layout::Heap, 320)?;
    let search = Search::new(10, f32::INFINITY).fit_start(&map, &photons);
    let (mut found, mut reads) = (Nearest::new(10, f32::INFINITY), SearchReads::default());
    search.run(&map, [0.501, 0.0, 0.502], &mut found, &mut reads);

    let mut flux = [0.0; 3];
    for (_, id) in found.iter() {
        let power = photons[id as usize].power();
        (0..3).for_each(|channel| flux[channel] += power[channel]);
    }
    let nearest = found.sorted().into_iter().map(|(squared, id)| (squared.sqrt(), id)).collect();
    Ok(Gathered { nearest, flux, reads: reads.len() })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Gathered { nearest, flux: [red, green, blue], reads } = gather()?;
    let mut out = io::stdout().lock();
    for (distance, id) in nearest {
        writeln!(out, "photon {id} at {distance:.4}")?;
    }
    writeln!(out, "flux {red:.2} {green:.2} {blue:.2}, found by {reads} reads")?;
    Ok(())
}
