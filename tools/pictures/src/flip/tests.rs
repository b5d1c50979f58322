//! FLIP against its authors' program, and against what follows from its definition.

use super::*;

const SIZE: [u32; 2] = [48, 40];

fn near(what: &str, found: f64, expected: f64) {
    assert!((found - expected).abs() < 2e-4, "{what}: {found}, not {expected}");
}

fn painted(colour: impl Fn(u32, u32) -> [f64; 3]) -> Picture {
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    #[expect(clippy::cast_possible_truncation, reason = "as the other program reads them")]
    Picture { size: SIZE, pixels: pixels.map(|(x, y)| colour(x, y).map(|c| c as f32)).collect() }
}

/// Slopes, edges and a pattern.
fn reference(x: u32, y: u32) -> [f64; 3] {
    let distance = f64::from(x.abs_diff(20) + y.abs_diff(12));
    let colour = [f64::from((7 * x + 3 * y) % 64) / 64.0, f64::from((x * x + 5 * y) % 97) / 97.0, distance / 60.0];
    if (x / 6 + y / 5).is_multiple_of(3) { [0.25 * colour[1], colour[0], 0.5] } else { colour }
}

/// Tinted, with a block of less contrast, and a speckle every 11 pixels.
fn changed(x: u32, y: u32) -> [f64; 3] {
    let [r, g, b] = reference(x, y);
    let mut colour = [r * 0.95, g, b * 1.02];
    if (10..20).contains(&x) && (8..30).contains(&y) {
        colour = colour.map(|c| c * 0.5 + 0.25);
    }
    if (x + SIZE[0] * y).is_multiple_of(11) { colour.map(|c| 1.0 - c) } else { colour }
}

#[test]
fn it_is_that_of_its_authors() {
    // By flip-evaluator 1.7, the authors' own, from these pictures.
    let (a, b) = (painted(reference), painted(changed));
    for (ppd, expected) in [(67.0206, 0.274_098_8), (30.0, 0.309_345_3), (10.0, 0.270_977_9)] {
        near("LDR", ldr_flip(&a, &b, ppd), expected);
    }
    let bright = |picture: &Picture| {
        let pixels = picture.pixels.iter().map(|pixel| pixel.map(|x| x * x * x * 50.0));
        Picture { size: SIZE, pixels: pixels.collect() }
    };
    for (ppd, expected) in [(67.0206, 0.367_886_4), (30.0, 0.399_687_9), (10.0, 0.348_289_4)] {
        let found = hdr_flip(&bright(&a), &bright(&b), ppd);
        near("HDR", found.mean, expected);
        let ([first, last], count) = found.exposures;
        near("first exposure", first, -4.354_831);
        near("last exposure", last, -1.782_027);
        assert_eq!(count, 3);
    }
}

#[test]
fn plain_colours_differ_as_its_authors_say() {
    let plain = |colour: [f64; 3]| painted(|_, _| colour);
    for (a, b, expected) in [
        ([0.0; 3], [1.0; 3], 0.967_395_1),
        ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0], 1.0),
        ([0.5; 3], [0.55; 3], 0.123_375_4),
        ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0.986_679_0),
    ] {
        near("plain", ldr_flip(&plain(a), &plain(b), PIXELS_PER_DEGREE), expected);
    }
}

#[test]
fn nothing_differs_from_itself_and_the_order_does_not_matter() {
    let (a, b) = (painted(reference), painted(changed));
    assert_eq!(ldr_flip(&a, &a, PIXELS_PER_DEGREE), 0.0);
    assert_eq!(hdr_flip(&a, &a, PIXELS_PER_DEGREE).mean, 0.0);
    let (there, back) = (ldr_flip(&a, &b, PIXELS_PER_DEGREE), ldr_flip(&b, &a, PIXELS_PER_DEGREE));
    assert!((there - back).abs() < 1e-6 && (0.0..=1.0).contains(&there), "{there} {back}");
}

#[test]
fn a_scale_common_to_both_does_not_matter_to_hdr() {
    // Exposures follow the reference.
    let (a, b) = (painted(reference), painted(changed));
    let found = hdr_flip(&a, &b, PIXELS_PER_DEGREE).mean;
    near("16 times brighter", hdr_flip(&a.exposed(4.0), &b.exposed(4.0), PIXELS_PER_DEGREE).mean, found);
}

#[test]
fn odd_pictures_are_no_fault() {
    let odd = |value: f32| Picture { size: [1, 1], pixels: vec![[value; 3]] };
    for value in [0.0, -1.0, f32::NAN, f32::INFINITY, f32::MAX, 1e-30] {
        let found = hdr_flip(&odd(0.5), &odd(value), PIXELS_PER_DEGREE).mean;
        assert!((0.0..=1.0).contains(&found), "{value}: {found}");
        let found = hdr_flip(&odd(value), &odd(0.5), PIXELS_PER_DEGREE).mean;
        assert!((0.0..=1.0).contains(&found), "{value}: {found}");
    }
}
