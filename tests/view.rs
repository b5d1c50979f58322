//! Do other renderers' points come in, go out again, and through every program; and are pictures compared rightly?

use crate::streams::check;
use crate::support::{Folder, same_text};
use pm_formats::vocabulary::measure;
use pm_pictures::{Picture, PictureFormat};

/// The same text but for the last digit of directions: those on an edge of the octahedron have two codes each.
fn same_numbers(what: &str, expected: &[u8], got: &[u8]) {
    let words = |text: &[u8]| -> Vec<String> {
        String::from_utf8(text.to_vec()).unwrap().split_whitespace().map(str::to_owned).collect()
    };
    let (expected, got) = (words(expected), words(got));
    assert_eq!(expected.len(), got.len(), "{what}");
    for (x, y) in expected.iter().zip(&got) {
        let near =
            |x: &str, y: &str| matches!((x.parse::<f64>(), y.parse::<f64>()), (Ok(x), Ok(y)) if (x - y).abs() < 3e-7);
        assert!(x == y || near(x, y), "{what}: {x} became {y}");
    }
}

#[test]
fn what_is_exported_can_be_imported() {
    let folder = Folder::with_streams();
    for (kind, file, options) in [("photons", "map.pmp", "--emitted 7"), ("queries", "q.pmq", "--size 16x12")] {
        let text = folder.run(&format!("pm-view --records {file} -o out.tsv")).ok();
        assert!(text.stdout.is_empty());
        let stream = folder.run(&format!("pm-view --import {kind} out.tsv {options}")).ok().stdout;
        assert!(check(&stream).unwrap().records > 100);
        let again = folder.feed("pm-view --records", &stream).ok().stdout;
        same_numbers(kind, &folder.read("out.tsv"), &again);
        // From a pipe all is the same but the name of the input.
        let piped = folder.feed(&format!("pm-view --import {kind} {options}"), &folder.read("out.tsv")).ok().stdout;
        assert_eq!(check(&piped).unwrap(), check(&stream).unwrap());
    }
}

#[test]
fn imported_points_go_through_every_program() {
    let folder = Folder::with_streams();
    let paths = folder.run("pm-view map.pmp").ok();
    let paths = paths.text().lines().find(|line| line.contains(measure::EMITTED_PATHS)).expect("a count").to_owned();
    let digits: String =
        paths.rsplit(measure::EMITTED_PATHS).next().unwrap().chars().filter(char::is_ascii_digit).collect();
    folder.run("pm-view --records map.pmp -o map.tsv").ok();
    folder.run("pm-view --records q.pmq -o q.tsv").ok();
    folder.run(&format!("pm-view --import photons map.tsv --emitted {digits} -o theirs.pmp")).ok();
    folder.run("pm-view --import queries q.tsv --size 16x12 -o theirs.pmq").ok();
    let table = folder
        .sh("pm-reorder hilbert theirs.pmq | pm-gather -q theirs.pmp --image theirs.exr | pm-cachesim --format csv");
    assert!(table.ok().text().lines().nth(1).is_some_and(|row| row.contains("imported, hilbert")));

    // The searches are those of the streams themselves.
    let tally = |line: &str| check(&folder.run(line).ok().stdout).unwrap();
    assert_eq!(tally("pm-gather map.pmp q.pmq"), tally("pm-gather -q theirs.pmp theirs.pmq"));
    assert!(Picture::decode_exr(&folder.read("theirs.exr")).unwrap().pixels.iter().flatten().sum::<f32>() > 0.0);
}

#[test]
fn faults_leave_no_output() {
    let folder = Folder::new();
    folder.write("bad.csv", "x,y,z\n1,2,3\n1,nan,3\n");
    let fault = folder.run("pm-view --import photons bad.csv -o out.pmp");
    same_text("fault", "pm-view: bad.csv: line 3: y is `nan`; a finite number is needed", fault.fails(1));
    assert!(folder.run("pm-view --import photons bad.csv").stdout.is_empty());
    for options in ["--columns x,y,z,powr_r", "--raw f32", "--size 2x2", "--emitted 0", "--check", "other.csv"] {
        assert_eq!(folder.run(&format!("pm-view --import photons bad.csv -o out.pmp {options}")).code, 2, "{options}");
    }
    folder.write("pixel.csv", "x,y,z,pixel\n1,2,3,0\n");
    let _ = folder.run("pm-view --import queries pixel.csv").fails(2);
    assert_eq!(folder.run("pm-view --columns x,y,z bad.csv").code, 2);
    assert_eq!(folder.names(), ["bad.csv", "pixel.csv"]);
    folder.write("more.csv", "x,y,z,colour\n1,2,3,red\n");
    let remark = folder.run("pm-view --import photons more.csv -o out.pmp");
    assert_eq!((remark.code, remark.stderr.trim()), (0, "pm-view: columns that are not used: colour"));
}

fn exr(folder: &Folder, name: &str, size: [u32; 2], value: f32) {
    let mut picture = Picture::black(size);
    picture.pixels.fill([value, 2.0 * value, 4.0 * value]);
    let bytes = picture.encode(PictureFormat::Exr, "pm 0.1", &[("photonmap.k", "9".into())]);
    folder.write(name, bytes.unwrap());
}

#[test]
fn two_pictures_are_compared() {
    let folder = Folder::new();
    exr(&folder, "a.exr", [3, 2], 1.0);
    exr(&folder, "b.exr", [3, 2], 1.01);
    exr(&folder, "c.exr", [2, 3], 1.0);
    let csv = folder.run("pm-view a.exr b.exr --format csv").ok();
    let mut lines = csv.text().lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (names, values) = (lines.next().unwrap(), lines.next().unwrap());
    let value = |name: &str| -> f64 { values[names.iter().position(|n| *n == name).unwrap()].parse().unwrap() };
    for name in ["ratio_r", "ratio_g", "ratio_b"] {
        assert!((value(name) - 1.01).abs() < 1e-6, "{name}");
    }
    assert!((value("max_difference") - 0.04).abs() < 1e-6);
    assert!((value("rmse") - (21e-4f64 / 3.0).sqrt()).abs() < 1e-6);
    assert_eq!((value("pixels"), value("differing")), (6.0, 6.0));
    // A hundredth more light is hardly seen: not at all in a preview that is clipped.
    assert!(value("hdr_flip") > 0.0 && value("hdr_flip") < 0.1 && value("ldr_flip") == 0.0, "{values:?}");
    let dark = folder.run("pm-view a.exr b.exr --format csv --exposure -3 --pixels-per-degree 30").ok();
    assert!(dark.text().ends_with(",30.0\n") && dark.text().contains(",-3.0,"), "{}", dark.text());
    let same = folder.run("pm-view a.exr a.exr --format json");
    assert_eq!((same.code, same.stderr.trim()), (0, "pm-view: the pictures are the same to the last bit"));
    assert!(same.text().contains("\"differing\": 0"), "{}", same.text());
    assert!(folder.run("pm-view a.exr c.exr").fails(1).contains("3x2 and 2x3"));
    let _ = folder.run("pm-view a.exr b.exr c.exr").fails(2);
    let _ = folder.run("pm-view --check a.exr").fails(2);
}

#[test]
fn a_difference_is_drawn() {
    let folder = Folder::new();
    exr(&folder, "a.exr", [6, 4], 0.25);
    let mut picture = Picture::black([6, 4]);
    picture.pixels.fill([0.25, 0.5, 1.0]);
    picture.pixels[8] = [0.75, 0.0, 1.0];
    folder.write("b.exr", picture.encode(PictureFormat::Exr, "pm 0.1", &[]).unwrap());
    // The table is printed, wherever the picture goes.
    let printed = folder.run("pm-view a.exr b.exr").ok();
    assert!(printed.text().contains("pixels       24, of which 1 differ\n"), "{}", printed.text());
    assert!(printed.text().lines().count() <= 8 && printed.text().lines().all(|line| line.len() < 100));
    for file in ["diff.png", "diff.exr"] {
        let drawn = folder.run(&format!("pm-view a.exr b.exr -o {file}")).ok();
        same_text(file, printed.text(), drawn.text());
    }
    let difference = Picture::decode_exr(&folder.read("diff.exr")).unwrap();
    let at = |pixel: usize| difference.pixels[pixel];
    assert_eq!((at(8), at(0), at(23)), ([0.5, 0.5, 0.0], [0.0; 3], [0.0; 3]));
    let flip = pm_pictures::Preview::decode(PictureFormat::Png, &folder.read("diff.png"), 0.0).unwrap();
    let brightness = |pixel: &[u8; 3]| pixel.iter().map(|&level| u32::from(level)).sum::<u32>();
    let brightest = flip.pixels.iter().enumerate().max_by_key(|(_, pixel)| brightness(pixel)).unwrap();
    assert_eq!(brightest.0, 8);
    // Of the same picture nothing is to be seen.
    folder.run("pm-view -q a.exr a.exr -o same.png").ok();
    let same = pm_pictures::Preview::decode(PictureFormat::Png, &folder.read("same.png"), 0.0).unwrap();
    assert!(same.pixels.iter().all(|pixel| *pixel == [0; 3]));
}

#[test]
fn streams_that_were_compressed_as_a_whole_are_read() {
    let folder = Folder::with_streams();
    for name in ["map.pmp", "q.pmq"] {
        folder.write(&format!("{name}.zst"), zstd::encode_all(&folder.read(name)[..], 3).unwrap());
    }
    let plain = folder.run("pm-gather map.pmp q.pmq").ok().stdout;
    let packed = folder.run("pm-gather map.pmp.zst q.pmq.zst").ok().stdout;
    assert_eq!(check(&packed).unwrap(), check(&plain).unwrap());
    let of = |line: &str| folder.run(line).ok().text().replace(".zst", "");
    same_text("view", &of("pm-view --records=5 map.pmp"), &of("pm-view --records=5 map.pmp.zst"));
    folder.write("t.pmt.zst", zstd::encode_all(&plain[..], 3).unwrap());
    folder.write("t.pmt", &plain);
    same_text("cachesim", &of("pm-cachesim t.pmt"), &of("pm-cachesim t.pmt.zst"));
    same_text("check", &of("pm-view --check t.pmt"), &of("pm-view --check t.pmt.zst"));
    let cut = &folder.read("map.pmp.zst")[..3000];
    folder.write("cut.zst", cut);
    assert!(folder.run("pm-view --check cut.zst").fails(3).contains("(zstd) is damaged or cut"));
}

/// Moves the data window of an EXR file to the right.
fn shifted(mut bytes: Vec<u8>, by: i32) -> Vec<u8> {
    let name = b"dataWindow\0box2i\0\x10\0\0\0";
    let at = bytes.windows(name.len()).position(|window| window == name).expect("a data window") + name.len();
    for corner in [at, at + 8] {
        let x = i32::from_le_bytes(bytes[corner..corner + 4].try_into().unwrap()) + by;
        bytes[corner..corner + 4].copy_from_slice(&x.to_le_bytes());
    }
    bytes
}

#[test]
fn a_picture_shifted_in_its_window_is_not_the_same() {
    let folder = Folder::with_streams();
    exr(&folder, "a.exr", [16, 12], 1.0);
    folder.write("b.exr", shifted(folder.read("a.exr"), 2));
    let compared = folder.run("pm-view a.exr b.exr");
    let said = "pm-view: data windows differ: 0,0,16,12 and 2,0,18,12; pixels are compared by their order in the files";
    assert_eq!((compared.code, compared.stderr.trim()), (0, said));
    let base = folder.run("pm-gather map.pmp q.pmq --base b.exr --no-trace --image x.exr");
    let said =
        "b.exr: cannot be added to the picture: data windows differ: 2,0,18,12 and 0,0,16,12; write it again in those";
    assert!(base.fails(1).contains(said), "{}", base.stderr);
    assert!(!folder.path("x.exr").exists());
    // A mean counts from the display window, in which the first two columns are not there.
    let mean = folder.run("pm-view b.exr --mean 2,0,4,1 --format csv").ok();
    assert!(mean.text().contains("b.exr,2,0,4,1,2,0,1.0,2.0,4.0"), "{}", mean.text());
    assert!(folder.run("pm-view b.exr --mean 0,0,4,1").fails(1).contains("2,0,18,12 of the display window"));
}

#[test]
fn pictures_without_a_finite_pixel_are_said_to_be_so() {
    let folder = Folder::new();
    exr(&folder, "a.exr", [3, 2], 1.0);
    exr(&folder, "i.exr", [3, 2], f32::INFINITY);
    let compared = folder.run("pm-view a.exr i.exr");
    assert!(compared.fails(1).ends_with("in none of the 6 pixels are both finite; there is nothing to compare"));
    let mean = folder.run("pm-view i.exr --mean all");
    assert!(mean.stderr.contains("i.exr: region all has no mean: none of its 6 pixels is finite"), "{}", mean.stderr);
    let text = folder.run("pm-view i.exr").ok().text().to_owned();
    assert!(text.contains("channel      R: none of its 6 values is finite\n"), "{text}");
}

#[test]
fn a_picture_is_described() {
    let folder = Folder::new();
    exr(&folder, "a.exr", [3, 2], 0.5);
    let text = folder.run("pm-view a.exr").ok().text().to_owned();
    assert!(
        text.starts_with("picture      3 x 2 pixels\nchannel      B: 2.000000 to 2.000000, mean 2.000000\n"),
        "{text}"
    );
    assert!(text.contains("comments     photonmap.k = 9\n") && text.contains("software     pm "), "{text}");
}

#[test]
fn rectangles_of_pictures_are_measured() {
    let folder = Folder::new();
    exr(&folder, "a.exr", [3, 2], 0.5);
    exr(&folder, "b.exr", [3, 2], 2.0);
    let csv = folder.run("pm-view a.exr b.exr --mean 1,0,3,1 --mean all --format csv").ok();
    same_text(
        "means",
        "picture,x0,y0,x1,y1,pixels,not_finite,r,g,b\n\
         a.exr,1,0,3,1,2,0,0.5,1.0,2.0\na.exr,0,0,3,2,6,0,0.5,1.0,2.0\n\
         b.exr,1,0,3,1,2,0,2.0,4.0,8.0\nb.exr,0,0,3,2,6,0,2.0,4.0,8.0\n",
        csv.text(),
    );
    let beyond = folder.run("pm-view a.exr --mean 0,0,3,3 -o means.csv");
    assert_eq!(beyond.fails(1), "pm-view: a.exr: region 0,0,3,3 reaches beyond the picture of 3x2 pixels");
    for line in ["pm-view a.exr --mean 0,0,3", "pm-view --mean all", "pm-view a.exr --mean all --check"] {
        assert_eq!(folder.run(line).code, 2, "{line}");
    }
    assert_eq!(folder.names(), ["a.exr", "b.exr"]);
}

#[test]
fn a_contact_sheet_appears_whole_or_not_at_all() {
    let folder = Folder::new();
    exr(&folder, "a.exr", [30, 20], 0.1);
    folder.run("pm-view a.exr --sheet b.png").ok();
    folder.run("pm-view a.exr b.png --sheet sheet.png --exposure 1").ok();
    let _ = folder.run("pm-view a.exr none.png --sheet other.png").fails(1);
    let _ = folder.run("pm-view a.exr --sheet sheet.exr").fails(2);
    assert_eq!(folder.names(), ["a.exr", "b.png", "sheet.png"]);
    assert!(folder.read("sheet.png").starts_with(b"\x89PNG"));
}
