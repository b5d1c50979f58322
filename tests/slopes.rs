//! Do noise and bias fall as fast as theory says, as rays and photons grow in number?

use crate::support::Folder;
use pm_pictures::Picture;

fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}.obj", env!("CARGO_MANIFEST_DIR"))
}

/// The picture of gathered light alone.
fn picture(folder: &Folder, scene_name: &str, queries: &str, gather: &str) -> Vec<[f32; 3]> {
    folder.run(&format!("pm-queries {} {queries} -o q.pmq", scene(scene_name))).ok();
    folder.run(&format!("pm-gather map.pmp q.pmq {gather} --no-trace --image x.exr")).ok();
    Picture::decode_exr(&folder.read("x.exr")).unwrap().pixels
}

/// Deviation of a pixel from one seed of the rays to the next, root of the mean square over the picture.
fn noise(folder: &Folder, options: &str) -> f64 {
    const SEEDS: u32 = 6;
    let pictures: Vec<_> = (0..SEEDS)
        .map(|seed| picture(folder, "cornell-diffuse", &format!("--size 16x16 --seed {seed} {options}"), "-k 50"))
        .collect();
    let mut sum = 0.0;
    for pixel in 0..pictures[0].len() {
        for channel in 0..3 {
            let values: Vec<f64> = pictures.iter().map(|picture| f64::from(picture[pixel][channel])).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            sum += values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(SEEDS - 1);
        }
    }
    (sum / (3 * pictures[0].len()) as f64).sqrt()
}

#[test]
fn noise_falls_at_least_as_the_root_of_the_gather_rays() {
    // Independent rays: slope -1/2. Here they are strata of a square: where radiance is smooth over a stratum, one ray in
    // each gives -1; where an edge runs through it, -3/4 (Mitchell, *Consequences of Stratified Sampling in Graphics*,
    // SIGGRAPH 1996). The blotches of the map are edges smaller than the strata, so the slope begins near -1/2. The
    // deviation is known to 1/sqrt(2 x 5 x 256 pixels) = 2 % or so: the slope to 0.02.
    let folder = Folder::new();
    folder.run(&format!("pm-photons {} -n 100000 -o map.pmp", scene("cornell-diffuse"))).ok();
    for guide in ["", "--guide map.pmp"] {
        let deviations = [4, 16, 64].map(|gathers| noise(&folder, &format!("--gathers {gathers} {guide}")));
        for pair in deviations.windows(2) {
            let slope = (pair[1] / pair[0]).ln() / 4f64.ln();
            assert!((-1.0..-0.45).contains(&slope), "`{guide}`: slope {slope}, deviations {deviations:?}");
        }
    }
}

#[test]
fn bias_at_edges_falls_as_the_radius_of_the_photons_disc() {
    // A wall of the furnace, edge to edge. The part of a disc that reaches beyond an edge holds no photons of the wall; its
    // mean over distances t < r is (1 / pi) x integral of (acos t - t sqrt(1 - t^2)) over 0..1 = 2 / (3 pi) of the disc,
    // so the wall of size 1 lacks 4 x 2 / (3 pi) x r of its light in all, with r = sqrt(k / (pi x density)): half as much
    // for four times the photons. Powers of blue are all alike, so their noise is least.
    let folder = Folder::new();
    let k = 50.0;
    let lacks = [10_000, 160_000].map(|photons| {
        let seeds = 3;
        let found: f64 = (0..seeds)
            .map(|seed| {
                folder.run(&format!("pm-photons {} -n {photons} --seed {seed} -o map.pmp", scene("furnace"))).ok();
                // Straight at the back wall, which fills the picture: its half is seen at tan 22.5 / 2 from a distance.
                let view = "--size 40x40 --eye 0,.5,.49 --look-at 0,.5,-.5 --vfov 53.6";
                let pixels =
                    picture(&folder, "furnace", &format!("{view} --direct-visualisation"), "-k 50 --edges ignored");
                pixels.iter().map(|pixel| f64::from(pixel[2])).sum::<f64>() / pixels.len() as f64 / f64::from(seeds)
            })
            .sum();
        let radius = (k / (std::f64::consts::PI * f64::from(photons) / 6.0)).sqrt();
        // Reflected: reflectance 0.8 of radiance 5.
        (1.0 - found / 4.0, 8.0 / (3.0 * std::f64::consts::PI) * radius)
    });
    for (lack, expected) in lacks {
        assert!((lack / expected - 1.0).abs() < 0.25, "{lacks:?}");
    }
    let slope = (lacks[1].0 / lacks[0].0).ln() / 16f64.ln();
    assert!((-0.62..-0.40).contains(&slope), "slope {slope}: {lacks:?}");
}

#[test]
fn near_edges_the_map_comes_nearer_to_the_reference_as_photons_grow() {
    // Rectangles of the 256 x 256 image by a path tracer that shares no code with this project (8,192 samples per pixel),
    // halved: the edges back/left and ceiling/back, the corner of back and floor, the ceiling beside the lamp.
    let regions = [
        (27..30, 35..90, [0.160_51, 0.079_622, 0.037_181]),
        (40..90, 27..29, [0.102_2, 0.070_957, 0.026_942]),
        (30..35, 99..103, [0.051_927, 0.020_577, 0.007_757_9]),
    ];
    let folder = Folder::new();
    let deviations = [10_000, 640_000].map(|photons| {
        folder.run(&format!("pm-photons {} -n {photons} -t 2 -o map.pmp", scene("cornell-diffuse"))).ok();
        let pixels = picture(&folder, "cornell-diffuse", "--size 128x128 --direct-visualisation", "-k 50");
        let mut sum = 0.0;
        for (columns, rows, expected) in regions.clone() {
            let size = f64::from((columns.end - columns.start) * (rows.end - rows.start));
            for (channel, expected) in expected.into_iter().enumerate() {
                let at = |x: u32, y: u32| f64::from(pixels[(y * 128 + x) as usize][channel]);
                let mean =
                    rows.clone().flat_map(|y| columns.clone().map(move |x| (x, y))).map(|(x, y)| at(x, y)).sum::<f64>();
                sum += (mean / size / expected - 1.0).powi(2) / 9.0;
            }
        }
        sum.sqrt()
    });
    assert!(deviations[1] < 0.3 * deviations[0] && deviations[1] < 0.1, "{deviations:?}");
}
