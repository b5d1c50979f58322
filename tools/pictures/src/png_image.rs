//! Pictures as PNG files of 8 bits.

use crate::{PictureError, Preview, Result, check_size};
use std::io::Cursor;

/// A file of 8-bit sRGB samples.
pub(crate) fn encode(size: [u32; 2], data: &[u8]) -> Result<Vec<u8>> {
    let mut bytes = vec![];
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().map_err(PictureError::PngNotEncoded)?;
    writer.write_image_data(data).map_err(PictureError::PngNotEncoded)?;
    writer.finish().map_err(PictureError::PngNotEncoded)?;
    Ok(bytes)
}

/// The colours in a file; opacity is left out.
pub(crate) fn decode(bytes: &[u8]) -> Result<Preview> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(PictureError::NotPng)?;
    let info = reader.info();
    check_size([info.width.into(), info.height.into()])?;
    let size = reader.output_buffer_size().ok_or(PictureError::NotPng(png::DecodingError::LimitsExceeded))?;
    let mut bytes = vec![0; size];
    let frame = reader.next_frame(&mut bytes).map_err(PictureError::NotPng)?;
    let samples = frame.color_type.samples();
    // Grey has one sample or two, colour three or four; the last of an even number is opacity.
    let colour = |pixel: &[u8]| if samples < 3 { [pixel[0]; 3] } else { [pixel[0], pixel[1], pixel[2]] };
    let pixels = bytes[..frame.buffer_size()].chunks_exact(samples).map(colour).collect();
    Ok(Preview { size: [frame.width, frame.height], pixels })
}
