//! Is the mean of an image that of its light, whatever its format, and is what is no image refused?

use super::*;
use image::{ExtendedColorType, GenericImage as _, Rgba, RgbaImage};

/// An image in a file of this format.
fn file(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(vec![]);
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// The mean of a file of this name.
fn of(name: &str, bytes: &[u8]) -> Texture {
    mean(Path::new(name), bytes)
}

#[test]
fn every_format_of_one_colour_has_that_colour() {
    let light = |x: u8| f64::from(x) / 255.0;
    let expected = [200, 90, 30].map(|x| libm::pow((light(x) + 0.055) / 1.055, 2.4) as f32);
    let image = DynamicImage::from(RgbaImage::from_pixel(9, 5, Rgba([200, 90, 30, 255])));
    let rgb = DynamicImage::from(image.to_rgb8());
    for (name, format, image) in [
        ("x.tga", ImageFormat::Tga, &image),
        ("x.tga", ImageFormat::Tga, &rgb),
        ("x.bmp", ImageFormat::Bmp, &rgb),
        ("x.tif", ImageFormat::Tiff, &rgb),
        ("x.gif", ImageFormat::Gif, &image),
        ("x.webp", ImageFormat::WebP, &rgb),
        ("x.ppm", ImageFormat::Pnm, &rgb),
        ("x.png", ImageFormat::Png, &image),
        ("x.jpg", ImageFormat::Jpeg, &rgb),
    ] {
        let found = of(name, &file(image, format)).unwrap_or_else(|why| panic!("{name}: {why}"));
        // JPEG rounds.
        let slack = if format == ImageFormat::Jpeg { 0.01 } else { 1e-6 };
        assert!((0..3).all(|c| (found[c] - expected[c]).abs() < slack), "{name}: {found:?}");
        // By how it begins, whatever it is called; Targa by its name alone.
        let by_beginning = of("x.dat", &file(image, format));
        assert_eq!(by_beginning.is_ok(), format != ImageFormat::Tga, "{name}");
    }
}

#[test]
fn the_mean_is_of_light() {
    // Half black, half white is 0.5 of the light, and 0.21 if numbers are averaged first.
    let mut image = RgbaImage::from_pixel(2, 1, Rgba([0, 0, 0, 255]));
    image.put_pixel(1, 0, Rgba([255; 4]));
    let image = DynamicImage::from(image);
    for image in [image.clone(), image.to_rgb8().into(), image.to_luma8().into(), image.to_luma_alpha8().into()] {
        assert_eq!(of("x.png", &file(&image, ImageFormat::Png)), Ok([0.5; 3]), "{:?}", image.color());
    }
    for deep in [DynamicImage::from(image.to_rgb16()), image.to_rgba16().into(), image.to_luma16().into()] {
        assert_eq!(of("x.png", &file(&deep, ImageFormat::Png)), Ok([0.5; 3]), "{:?}", deep.color());
    }
    let floats = DynamicImage::from(image.to_rgb32f());
    assert_eq!(of("x.tiff", &file(&floats, ImageFormat::Tiff)), Ok([0.5; 3]));
}

#[test]
fn what_is_not_seen_does_not_count() {
    // Half of it white and opaque, half black with alpha 0.
    let mut image = DynamicImage::from(RgbaImage::from_pixel(8, 8, Rgba([255; 4])));
    (0..8).for_each(|y| (0..4).for_each(|x| image.put_pixel(x, y, Rgba([0; 4]))));
    for format in [ImageFormat::Png, ImageFormat::Tga, ImageFormat::Gif, ImageFormat::WebP] {
        assert_eq!(of("x.tga", &file(&image, format)), Ok([1.0; 3]), "{format:?}");
    }
    let unseen = DynamicImage::from(RgbaImage::from_pixel(3, 3, Rgba([255, 255, 255, 0])));
    assert!(of("x.png", &file(&unseen, ImageFormat::Png)).is_err_and(|why| why.contains("alpha is 0")));
}

#[test]
fn absurd_sizes_are_refused_before_they_are_allocated() {
    // Headers of images of 4 billion texels and more, and nothing behind them.
    let bmp = |side: i32| {
        let mut bytes = b"BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0".to_vec();
        [side, side].iter().for_each(|side| bytes.extend(side.to_le_bytes()));
        bytes.extend([1, 0, 24, 0, 0, 0, 0, 0]);
        bytes.extend([0; 20]);
        bytes
    };
    let mut tga = vec![0; 18];
    (tga[2], tga[16]) = (2, 24);
    tga[12..16].fill(0xff);
    let mut png = vec![];
    let encoder = image::codecs::png::PngEncoder::new(&mut png);
    image::ImageEncoder::write_image(encoder, &[0; 3], 1, 1, ExtendedColorType::Rgb8).unwrap();
    png[16..24].fill(0x7f);
    for (name, bytes) in
        [("x.bmp", bmp(60_000)), ("x.tga", tga), ("x.ppm", b"P6\n99999999 99999999\n255\n".to_vec()), ("x.png", png)]
    {
        assert!(of(name, &bytes).is_err_and(|why| !why.contains('\n')), "{name}");
    }
}

#[test]
fn damaged_images_are_refused() {
    for bytes in [&b""[..], b"BM", b"\x89PNG\r\n\x1a\n", b"\x89PNG", &[0xff, 0xd8], &[0xff, 0xd8, 0xff, 0xc0, 0, 9, 9]]
    {
        assert!(of("x", bytes).is_err_and(|why| !why.contains('\n')), "{bytes:?}");
        assert!(of("x.tga", bytes).is_err_and(|why| !why.contains('\n')), "{bytes:?}");
    }
}
