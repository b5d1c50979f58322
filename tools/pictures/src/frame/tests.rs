//! Are windows, primaries and channels of EXR files seen for what they are?

use super::*;
use crate::Picture;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, IntegerBounds, Layer, LayerAttributes, Vec2,
    WritableImage as _,
};

/// A file of 3 x 2 pixels whose value is their index, at a place in its display window.
pub(crate) fn file(at: [i32; 2], display: [i32; 4], primaries: Option<Chromaticities>, names: &[&str]) -> Vec<u8> {
    let channels = names.iter().map(|name| AnyChannel::new(*name, FlatSamples::F32((0..6u8).map(f32::from).collect())));
    let attributes = LayerAttributes { layer_position: Vec2(at[0], at[1]), ..LayerAttributes::default() };
    let layer = Layer::new((3, 2), attributes, Encoding::UNCOMPRESSED, AnyChannels::sort(channels.collect()));
    let mut image = Image::from_layer(layer);
    let [x0, y0, x1, y1] = display;
    image.attributes.display_window = IntegerBounds::new((x0, y0), ((x1 - x0) as usize, (y1 - y0) as usize));
    image.attributes.chromaticities = primaries;
    let mut bytes = Cursor::new(vec![]);
    image.write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

const RGB: &[&str] = &["R", "G", "B"];

#[test]
fn a_shifted_window_and_other_primaries_differ_from_ours() {
    let ours = Frame::of_exr(&file([0, 0], [0, 0, 3, 2], None, RGB)).unwrap();
    assert_eq!((ours, ours.difference(&ours)), (Frame::plain([3, 2]), None));
    let shifted = Frame::of_exr(&file([2, -1], [0, 0, 3, 2], None, RGB)).unwrap();
    assert_eq!(ours.difference(&shifted).unwrap(), "data windows differ: 0,0,3,2 and 2,-1,5,1");
    let aces = Chromaticities {
        red: Vec2(0.7347, 0.2653),
        green: Vec2(0.0, 1.0),
        blue: Vec2(0.0001, -0.077),
        white: Vec2(0.32168, 0.33767),
    };
    let other = Frame::of_exr(&file([0, 0], [0, 0, 3, 2], Some(aces), RGB)).unwrap();
    assert!(ours.difference(&other).unwrap().starts_with("primaries differ: 0.64 0.33, "));
    let [red, green, blue, white] = REC_709.map(|[x, y]| Vec2(x, y + 2e-4));
    let same = file([0, 0], [0, 0, 3, 2], Some(Chromaticities { red, green, blue, white }), RGB);
    assert_eq!(ours.difference(&Frame::of_exr(&same).unwrap()), None);
}

#[test]
fn regions_count_from_the_display_window() {
    // Pixels 10 to 13 across and 5 to 7 down, of a display from 8, 4 to 20, 12.
    let bytes = file([10, 5], [8, 4, 20, 12], None, RGB);
    let (frame, picture) = (Frame::of_exr(&bytes).unwrap(), Picture::decode_exr(&bytes).unwrap());
    let mean = |region: &str| frame.mean(&picture, region.parse().unwrap());
    let found = mean("3,2,5,3").unwrap();
    assert_eq!((found.rectangle, found.mean), ([3, 2, 5, 3], [4.5; 3]));
    let found = mean("all").unwrap();
    assert_eq!((found.rectangle, found.pixels), ([2, 1, 5, 3], 6));
    for beyond in ["1,1,3,2", "2,1,6,2", "2,1,3,4"] {
        let said = mean(beyond).unwrap_err().to_string();
        assert_eq!(
            said,
            format!("region {beyond} reaches beyond the pixels that are there, 2,1,5,3 of the display window")
        );
    }
    let plain = Frame::plain([3, 2]).mean(&picture, "0,0,4,1".parse().unwrap()).unwrap_err();
    assert_eq!(plain.to_string(), "region 0,0,4,1 reaches beyond the picture of 3x2 pixels");
}

#[test]
fn channels_that_are_there_are_named_where_those_wanted_are_not() {
    for names in [&["left.R", "left.G", "left.B"][..], &["Y"]] {
        let bytes = file([0, 0], [0, 0, 3, 2], None, names);
        let mut sorted = names.to_vec();
        sorted.sort_unstable();
        let said = format!("this EXR image has no channels R, G and B; it has {}", sorted.join(", "));
        assert_eq!(Picture::decode_exr(&bytes).unwrap_err().to_string(), said);
        assert_eq!(Frame::of_exr(&bytes).unwrap_err().to_string(), said);
    }
}
