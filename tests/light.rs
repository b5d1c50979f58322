//! Is the picture that of a correct renderer?

use crate::support::Folder;
use pm_tools::image::Picture;
use std::ops::Range;

fn scene(name: &str) -> String {
    format!("{}/../scenes/{name}.obj", env!("CARGO_MANIFEST_DIR"))
}

/// Renders a scene through the programs.
fn render(scene_name: &str, photons: u32, size: u32, gathers: u32) -> Picture {
    let (folder, scene) = (Folder::new(), scene(scene_name));
    folder.run(&format!("pm-photons {scene} -n {photons} -t 2 -o map.pmp")).ok();
    folder
        .run(&format!("pm-queries {scene} --size {size}x{size} --gathers {gathers} -t 2 --base base.exr -o q.pmq"))
        .ok();
    folder.run("pm-gather map.pmp q.pmq --base base.exr --image x.exr --no-trace -t 2").ok();
    Picture::read_exr(&folder.path("x.exr")).unwrap()
}

/// Mean of a rectangle of pixels, per channel.
fn mean(picture: &Picture, columns: Range<u32>, rows: Range<u32>) -> [f64; 3] {
    let count = f64::from((columns.end - columns.start) * (rows.end - rows.start));
    let mut sum = [0f64; 3];
    for y in rows {
        for x in columns.clone() {
            let pixel = picture.pixels[(y * picture.size[0] + x) as usize];
            (0..3).for_each(|channel| sum[channel] += f64::from(pixel[channel]) / count);
        }
    }
    sum
}

/// Found over expected, the channel where they differ most.
fn worst(found: [f64; 3], expected: [f64; 3]) -> f64 {
    let ratios = (0..3).map(|channel| found[channel] / expected[channel]);
    ratios.max_by(|a, b| (a - 1.0).abs().total_cmp(&(b - 1.0).abs())).unwrap()
}

#[test]
fn in_a_furnace_every_pixel_shows_the_known_radiance() {
    // L = Le / (1 - rho) = 1.25, 2, 5 everywhere: photons, estimate, gather weights, and emission seen by eye must all
    // be right for this. Gather points within a photon radius of an edge of the room see too few photons on their own
    // wall; with a million photons that is 1 % of the indirect light at most.
    let picture = render("furnace", 1_000_000, 24, 64);
    let ratio = worst(mean(&picture, 0..24, 0..24), [1.25, 2.0, 5.0]);
    assert!((ratio - 1.0).abs() < 0.012, "mean / known = {ratio}");
}

#[test]
fn the_diffuse_box_is_that_of_an_independent_path_tracer() {
    // Means of rectangles of the 256 x 256 image by a path tracer that shares no code with this project (8,192 samples
    // per pixel, no depth limit), pixel rectangles halved here. Tolerances: what a photon map of this size can do away
    // from edges, and at them.
    let picture = render("cornell-diffuse", 1_000_000, 128, 36);
    let regions = [
        ("back_centre", 55..75, 30..50, [0.295_64, 0.222_21, 0.101_57], 0.02),
        ("back_upper_left", 30..40, 31..45, [0.191_51, 0.107_42, 0.049_443], 0.03),
        ("red_wall", 7..22, 30..90, [0.209_98, 0.014_658, 0.005_661_1], 0.03),
        ("green_wall", 106..121, 30..90, [0.049_011, 0.118_37, 0.010_884], 0.03),
        ("ceiling_left", 20..45, 7..15, [0.107_22, 0.053_242, 0.021_99], 0.03),
        ("floor_front", 45..85, 118..124, [0.135_23, 0.092_368, 0.043_903], 0.02),
        ("floor_left", 25..40, 113..122, [0.208_86, 0.135_51, 0.064_802], 0.02),
        ("shadow_of_short", 100..110, 116..121, [0.027_779, 0.040_172, 0.008_267_5], 0.10),
        ("tall_front", 43..63, 60..100, [0.106_17, 0.076_915, 0.033_79], 0.03),
        ("short_front", 70..90, 91..113, [0.022_953, 0.013_159, 0.005_911_7], 0.04),
    ];
    let mut report = String::new();
    let mut good = true;
    for (name, columns, rows, expected, tolerance) in regions {
        let ratio = worst(mean(&picture, columns, rows), expected);
        good &= (ratio - 1.0).abs() < tolerance;
        report += &format!("{name} {ratio:.4} (within {tolerance})\n");
    }
    assert!(good, "found / expected:\n{report}");
}
