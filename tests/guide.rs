//! Do photons that guide the gather rays change the noise only, and does the stream say so?

use crate::cli::asked_wrongly;
use crate::streams::records;
use crate::support::Folder;
use pm_formats::vocabulary::meaning;
use pm_formats::{BlockReader, Query};
use pm_pictures::Picture;

/// Means over a picture of the light that gather rays bring, per seed.
fn means(folder: &Folder, options: &str) -> Vec<f64> {
    let mean = |seed: u32| {
        let line = "pm-queries --size 20x20 --gathers 16 --no-caustics -o q.pmq";
        folder.run(&format!("{line} --seed {seed} {options}")).ok();
        folder.run("pm-gather map.pmp q.pmq -k 50 --no-trace --image x.exr").ok();
        let pixels = Picture::decode_exr(&folder.read("x.exr")).unwrap().pixels;
        pixels.iter().flatten().map(|&x| f64::from(x)).sum::<f64>() / 1200.0
    };
    (1..=8).map(mean).collect()
}

#[test]
fn the_mean_of_the_picture_is_that_without_a_guide() {
    let folder = Folder::new();
    folder.run("pm-photons -n 150000 -o map.pmp").ok();
    for options in ["", "--min-gather-dist auto", "--samples 2"] {
        let spread = |values: &[f64]| {
            let (n, mean) = (values.len() as f64, values.iter().sum::<f64>() / values.len() as f64);
            (mean, values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0) / n)
        };
        let cosine = spread(&means(&folder, options));
        let guided = spread(&means(&folder, &format!("{options} --guide map.pmp")));
        // Standard error of the difference, of eight pictures each.
        let error = (cosine.1 + guided.1).sqrt();
        assert!(error < 0.01 * cosine.0, "`{options}`: too noisy to tell: {error}");
        assert!((cosine.0 - guided.0).abs() < 4.0 * error, "`{options}`: {cosine:?} by the cosine, {guided:?} guided");
    }
}

#[test]
fn the_stream_says_what_guided_it() {
    let folder = Folder::new();
    folder.run("pm-photons -n 150000 -o map.pmp").ok();
    let line = "pm-queries --size 8x8 --gathers 4 --guide";
    let guided = folder.run(&format!("{line} map.pmp")).ok().stdout;
    let header = BlockReader::new(&guided[..]).unwrap().header().clone();
    assert_eq!(header.meaning(meaning::SAMPLING), Some("guided"));
    let check = folder.run("pm-view --check map.pmp").ok();
    let digest = check.text().split_whitespace().last().unwrap();
    let guide = header.meaning(meaning::GUIDE).unwrap();
    assert!(guide.contains(digest.trim_end_matches('.')), "{guide} / {}", check.text());
    folder.write("q.pmq", &guided);
    let history = folder.run("pm-view --history q.pmq").ok();
    assert_eq!(history.text(), "pm-photons -n 150000 > map.pmp\npm-queries --size 8x8 --gathers 4 --guide map.pmp\n");

    let summary = folder.run("pm-view q.pmq").ok();
    let line_of = |word: &str| summary.text().lines().find(|line| line.contains(word)).unwrap_or_default().to_owned();
    let guided_points = line_of("points_guided");
    assert!(!guided_points.is_empty() && !guided_points.ends_with(" 0"), "{}", summary.text());

    // From a pipe the records are the same; another guide makes others.
    let piped = folder.feed(&format!("{line} -"), &folder.read("map.pmp")).ok().stdout;
    assert!(records::<Query>(&piped) == records::<Query>(&guided));
    folder.run("pm-photons -n 150000 --seed 2 -o other.pmp").ok();
    let other = folder.run(&format!("{line} other.pmp")).ok().stdout;
    assert!(records::<Query>(&other) != records::<Query>(&guided));
}

#[test]
fn what_cannot_guide_is_told() {
    let folder = Folder::with_streams();
    for (options, named) in [
        ("--guide map.pmp --irradiance-cache 0.1", "gradients"),
        ("--guide map.pmp --direct-visualisation", "--direct-visualisation"),
        ("--guide map.pmp --sampling uniform", "--sampling uniform"),
    ] {
        let message = folder.run(&format!("pm-queries {options}"));
        assert!(asked_wrongly(&message).contains(named), "{options}");
    }
    assert!(folder.run("pm-queries --guide nosuch.pmp").fails(1).contains("nosuch.pmp"));
    assert!(folder.run("pm-queries --guide q.pmq").fails(2).contains("q.pmq"));
    let map = folder.read("map.pmp");
    folder.write("cut.pmp", &map[..map.len() - 9]);
    assert!(folder.run("pm-queries --guide cut.pmp").fails(3).contains("cut.pmp"));

    // No photons: said, and as without a guide.
    let plain = folder.run("pm-queries --size 8x8 --gathers 4").ok().stdout;
    folder.write("none.csv", "x,y,z\n");
    folder.run("pm-view -q --import photons none.csv -o none.pmp").ok();
    let outcome = folder.run("pm-queries --size 8x8 --gathers 4 --guide none.pmp");
    assert!(outcome.fails(0).contains("none.pmp holds no photons"), "{}", outcome.stderr);
    assert!(records::<Query>(&outcome.stdout) == records::<Query>(&plain));

    // Too few: said, not claimed, and as without a guide.
    folder.run("pm-photons -n 30 -o few.pmp").ok();
    let outcome = folder.run("pm-queries --size 8x8 --gathers 4 --guide few.pmp");
    assert!(outcome.fails(0).contains("photons are too few to guide"), "{}", outcome.stderr);
    assert!(records::<Query>(&outcome.stdout) == records::<Query>(&plain));
    assert_eq!(BlockReader::new(&outcome.stdout[..]).unwrap().header().meaning(meaning::SAMPLING), None);

    // Not many are enough: cells are as full as the photons allow.
    folder.run("pm-queries --size 8x8 --gathers 4 --guide map.pmp -o guided.pmq").ok();
    let shown = folder.run("pm-view guided.pmq").ok();
    let of = |name: &str| -> u64 {
        let line = shown.text().lines().find(|line| line.contains(name)).unwrap_or_else(|| panic!("no {name}"));
        line.split_whitespace().last().and_then(|number| number.replace(',', "").parse().ok()).expect("a number")
    };
    // Of the points seen, which send four gather rays each, a third at least.
    assert!(3 * of("points_guided") > of("gather_rays ") / 4, "{}", shown.text());

    // Photons of a scene three times as large.
    folder.write("far.mtl", "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n");
    folder.write(
        "far.obj",
        "mtllib far.mtl\nv -3 0 -3\nv -3 0 3\nv 3 0 3\nv 3 0 -3\nv -1 3 -1\nv 1 3 -1\nv 1 3 1\nv -1 3 1\n\
         usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n",
    );
    folder.run("pm-photons far.obj -n 5000 -o far.pmp").ok();
    let outcome = folder.run("pm-queries --size 8x8 --gathers 4 --guide far.pmp");
    assert!(outcome.fails(0).contains("far.pmp is not of this scene"), "{}", outcome.stderr);
    folder.run("pm-queries --size 8x8 --gathers 4 --guide far.pmp -q").ok();
}
