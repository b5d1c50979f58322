//! Pictures come back as they were, and are shown as a screen shows them.

use super::*;
use crate::Description;
use crate::PictureFormat;

fn picture() -> Picture {
    let pixels = (0..12u8).map(|i| [f32::from(i) * 0.1, 1e-6, f32::from(i) * 7e4]).collect();
    Picture { size: [4, 3], pixels }
}

fn exr() -> Vec<u8> {
    picture().encode(PictureFormat::Exr, "pm", &[("photonmap.k", "100".into())]).unwrap()
}

#[test]
fn exr_keeps_every_bit_and_equal_pictures_are_equal_files() {
    assert_eq!(Picture::decode_exr(&exr()).unwrap(), picture());
    assert_eq!(exr(), exr());
}

#[test]
fn a_stop_is_a_factor_of_two() {
    let exposed = picture().exposed(-1.0);
    assert_eq!(exposed.pixels[3], picture().pixels[3].map(|x| x / 2.0));
    assert_eq!(picture().exposed(0.0), picture());
    // 0.5 is clipped nowhere, and everywhere one and a half stops up.
    let grey = Picture { size: [2, 1], pixels: vec![[0.5; 3]; 2] };
    assert_eq!([0.0, 1.0, 1.5].map(|stops| grey.exposed(stops).clipped()), [0.0, 0.0, 1.0]);
}

#[test]
fn a_picture_is_described() {
    let description = Description::of_exr(&exr()).unwrap();
    assert_eq!(description.size, [4, 3]);
    // Channels stand in alphabetical order: B, G, R.
    let names: Vec<_> = description.channels.iter().map(|channel| &*channel.name).collect();
    assert_eq!(names, ["B", "G", "R"]);
    let blue = &description.channels[0];
    assert_eq!((blue.min, blue.mean, blue.max, blue.not_finite), (0.0, 385_000.0, 770_000.0, 0));
    assert!(description.attributes.contains(&("comments".into(), "photonmap.k = 100".into())));
}

#[test]
fn what_is_no_picture_is_refused() {
    let cut = exr();
    for bytes in [&b""[..], b"P6 1 1", &cut[..cut.len() - 1], &cut[..20]] {
        assert!(matches!(Picture::decode_exr(bytes), Err(PictureError::NotExr(_))));
        assert!(matches!(Preview::decode(PictureFormat::Png, bytes, 0.0), Err(PictureError::NotPng(_))));
    }
    let added = picture().add(&Picture::black([3, 4]));
    assert!(matches!(added, Err(PictureError::SizesDiffer([4, 3], [3, 4]))));
}
