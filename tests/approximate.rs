//! Is the error of light that a report tells that of the pictures, where each pixel is one query?

use crate::support::Folder;
use pm_pictures::Picture;
use std::collections::HashMap;

/// The picture that a map gives, and the numbers of its report.
fn gathered(folder: &Folder, options: &str) -> (Vec<f64>, HashMap<String, f64>) {
    folder.run(&format!("pm-gather map.pmp q.pmq -k 20 --no-trace --image x.exr --report r.csv {options}")).ok();
    let text = String::from_utf8(folder.read("r.csv")).unwrap();
    let (names, values) = text.trim().split_once('\n').expect("two lines");
    let numbers = names.split(',').zip(values.split(','));
    let numbers = numbers.filter_map(|(name, value)| Some((name.to_owned(), value.parse().ok()?))).collect();
    let pixels = Picture::decode_exr(&folder.read("x.exr")).unwrap().pixels;
    (pixels.into_iter().flatten().map(f64::from).collect(), numbers)
}

#[test]
fn the_error_of_light_is_that_of_the_picture() {
    let folder = Folder::new();
    // No mirror and no glass, which would make two queries of one pixel.
    let scene = format!("{}/../../scenes/cornell-diffuse.obj", env!("CARGO_MANIFEST_DIR"));
    folder.run(&format!("pm-photons {scene} -n 20000 -o map.pmp")).ok();
    folder.run(&format!("pm-queries {scene} --direct-visualisation --size 30x30 -o q.pmq")).ok();
    let (exact, report) = gathered(&folder, "");
    let queries = report["queries"];
    assert!(queries > 500.0 && queries <= 900.0 && !report.contains_key("light_bias"), "{queries}");
    let sum = exact.iter().sum::<f64>();
    for options in ["--map block-hash --budget 3", "--map block-hash --line 32 --slots 2", "--map grid-fixed --slots 3"]
    {
        let (other, report) = gathered(&folder, options);
        let squares = other.iter().zip(&exact).map(|(x, exact)| (x - exact).powi(2)).sum::<f64>();
        let rms = (squares / (3.0 * queries)).sqrt() / (sum / (3.0 * queries));
        let bias = other.iter().sum::<f64>() / sum - 1.0;
        assert_eq!(report["sampled_queries"], queries);
        let (its_rms, its_bias) = (report["light_error_rms"], report["light_bias"]);
        // Pixels are single-precision numbers.
        assert!((its_rms - rms).abs() < 1e-5 * rms && rms > 0.01, "{options}: {its_rms} for {rms}");
        assert!((its_bias - bias).abs() < 1e-6, "{options}: {its_bias} for {bias}");
    }
}
