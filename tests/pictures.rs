//! Do the pictures of `pm-gather` say where they come from, and does exposure brighten previews alone?

use crate::support::{Folder, peak_memory, same_bytes};
use pm_pictures::{Description, Picture, PictureFormat};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The comments of an EXR file, line by line.
fn comments(folder: &Folder, name: &str) -> Vec<String> {
    let description = Description::of_exr(&folder.read(name)).unwrap();
    let comments = description.attributes.into_iter().find(|(name, _)| name == "comments").expect("comments");
    comments.1.lines().map(str::to_owned).collect()
}

#[test]
fn an_exr_picture_says_how_it_was_made() {
    let folder = Folder::with_streams();
    let run = |options: &str, name: &str| {
        folder.run(&format!("pm-gather -q map.pmp q.pmq {options} --no-trace --image {name}")).ok();
        comments(&folder, name)
    };
    let plain = run("-k 37", "a.exr");
    // Of the photons their history; of the queries number and digest, which are the same in every order.
    let checked = |name: &str| {
        let line = folder.run(&format!("pm-view --check {name}")).ok().text().to_owned();
        let words: Vec<&str> = line.split_whitespace().collect();
        format!("{}, digest {}", words[2], words.last().expect("a digest"))
    };
    for expected in [
        "photonmap.k = 37".to_owned(),
        "photonmap.estimator = Unbiased".to_owned(),
        "photonmap.kernel = Constant".to_owned(),
        "photonmap.edges = Cut".to_owned(),
        "photonmap.gathers = 4".to_owned(),
        "photonmap.history = pm-photons -n 2000".to_owned(),
        format!("photonmap.photons = {}", checked("map.pmp")),
        format!("photonmap.queries = {}", checked("q.pmq")),
    ] {
        assert!(plain.contains(&expected), "{expected}\n{plain:#?}");
    }
    assert!(!plain.iter().any(|line| line.starts_with("photonmap.precomputed")), "{plain:#?}");
    let other = run("-k 37 --estimator classic --kernel cone --edges ignored --precomputed", "b.exr");
    for expected in [
        "photonmap.estimator = Classic",
        "photonmap.kernel = Cone",
        "photonmap.edges = Ignored",
        "photonmap.precomputed = at 1 of 4 photons",
    ] {
        assert!(other.iter().any(|line| line == expected), "{expected}\n{other:#?}");
    }
}

#[test]
fn equal_runs_give_equal_bytes() {
    let folder = Folder::with_streams();
    let run = |name: &str| {
        folder.run(&format!("pm-gather map.pmp q.pmq --no-trace --image {name}.exr --image {name}.png -q")).ok();
        [folder.read(&format!("{name}.exr")), folder.read(&format!("{name}.png"))]
    };
    for (first, second) in run("one").iter().zip(&run("two")) {
        same_bytes("the same again", first, second);
    }
}

/// Bytes of the pixels of a PNG file.
fn png_pixels(path: &Path) -> Vec<u8> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().expect("a small picture")];
    reader.next_frame(&mut bytes).unwrap();
    bytes
}

#[test]
fn exposure_doubles_the_light_of_previews_alone() {
    let folder = Folder::with_streams();
    // No photon counts, so that the picture is its base: half, once and twice the linear value whose sRGB byte is 128.
    let middle = 0.215_861;
    let pixels = (0..16 * 12).map(|i| [[0.5, 1.0, 2.0][i % 3] * middle; 3]).collect();
    let base = Picture { size: [16, 12], pixels };
    folder.write("base.exr", base.encode(PictureFormat::Exr, "pm", &[]).unwrap());
    // From the standard's curve, 255 (1.055 x^(1/2.4) - 0.055), for a quarter of the middle to four times it.
    let curve = [66, 92, 128, 176, 239];
    for (stops, from) in [(-1, 0), (0, 1), (1, 2)] {
        let line = format!("pm-gather map.pmp q.pmq --max-dist 0 --no-trace --base base.exr --exposure {stops}");
        folder.run(&format!("{line} --image x.exr --image x.png")).ok();
        let expected: Vec<u8> = (0..16 * 12).flat_map(|i| [curve[from + i % 3]; 3]).collect();
        assert_eq!(png_pixels(&folder.path("x.png")), expected, "{stops} stops");
        assert_eq!(Picture::decode_exr(&folder.read("x.exr")).unwrap(), base, "{stops} stops");
    }
}

#[test]
fn pictures_of_other_seeds_say_what_noise_they_share() {
    // Catches: the whole difference taken for the noise of one, and noise claimed where more differs than seeds.
    let folder = Folder::new();
    let make = |options: &str, name: &str| {
        let small = "--size 12x12 --samples 4 -n 2000 --caustics 0";
        folder.run(&format!("pm-picture -q {small} {options} --image {name}")).ok();
    };
    make("--seed 1", "a.exr");
    make("--seed 2", "b.exr");
    make("--seed 2 -k 5", "c.exr");
    let said = folder.run("pm-view a.exr b.exr --format csv");
    let row: Vec<&str> = said.text().lines().nth(1).expect("a row").split(',').collect();
    let rel_mse: f64 = row[9].parse().expect("a number");
    assert!(said.stderr.contains(&format!("half of rel_mse, {:.3e}, is the noise", rel_mse / 2.0)), "{}", said.stderr);
    folder.run("pm-view a.exr c.exr").ok();
    assert!(folder.run("pm-view a.exr a.exr").stderr.contains("the same to the last bit"));
}

#[test]
fn a_gather_takes_at_most_60_bytes_a_photon() {
    // Catches: what is known of photons held twice while it is put in the map's order.
    let folder = Folder::new();
    folder.run("pm-queries -q --size 96x96 --gathers 16 -t 2 -o q.pmq").ok();
    let [few, many] = [200_000, 1_000_000].map(|photons| {
        folder.run(&format!("pm-photons -q -n {photons} -t 2 -o map.pmp")).ok();
        peak_memory(&folder, "pm-gather -q -t 1 --map wide map.pmp q.pmq --image i.exr")
    });
    let bytes = (many - few) * 1024.0 / 800_000.0;
    assert!(bytes <= 60.0, "{bytes} bytes a photon");
    assert!(bytes > 20.0, "no less than the photons: {bytes}");
}
