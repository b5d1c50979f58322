//! Pictures as OpenEXR files.

use crate::{Picture, PictureError, Result, check_size, frame};
use exr::meta::MetaData;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder,
    ReadChannels as _, ReadLayers as _, Text, WritableImage as _, read,
};
use std::io::Cursor;

/// A picture as a file, with the name and version of the software that made it, and attributes as comments.
pub(crate) fn encode(picture: &Picture, software: &str, attributes: &[(&str, String)]) -> Result<Vec<u8>> {
    let channel = |index: usize, name: &str| {
        let samples = picture.pixels.iter().map(|pixel| pixel[index]).collect();
        AnyChannel::new(name, FlatSamples::F32(samples))
    };
    // One text and not attributes of their own: the library keeps those in no fixed order.
    let comments: Vec<String> = attributes.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let layer = LayerAttributes {
        software_name: Text::new_or_none(software),
        comments: Text::new_or_none(comments.join("\n")),
        ..LayerAttributes::default()
    };
    let channels = AnyChannels::sort([channel(0, "R"), channel(1, "G"), channel(2, "B")].into_iter().collect());
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let size = (picture.size[0] as usize, picture.size[1] as usize);
    let image = Image::from_layer(Layer::new(size, layer, encoding, channels));
    let mut bytes = Cursor::new(vec![]);
    image.write().non_parallel().to_buffered(&mut bytes).map_err(PictureError::ExrNotEncoded)?;
    Ok(bytes.into_inner())
}

/// The first layer with channels R, G, B.
pub(crate) fn decode(bytes: &[u8]) -> Result<Picture> {
    // Before anything is allocated for it.
    for header in MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(PictureError::NotExr)?.headers {
        check_size([header.layer_size.width() as u64, header.layer_size.height() as u64])?;
    }
    let black = |size: exr::math::Vec2<usize>, _: &_| Picture::black([size.width() as u32, size.height() as u32]);
    let set = |picture: &mut Picture, at: exr::math::Vec2<usize>, (r, g, b, _): (f32, f32, f32, f32)| {
        let index = at.y() * picture.size[0] as usize + at.x();
        picture.pixels[index] = [r, g, b];
    };
    let reader = read().no_deep_data().largest_resolution_level().rgba_channels(black, set);
    let image = reader.first_valid_layer().all_attributes().from_buffered(Cursor::new(bytes));
    Ok(image.map_err(|error| frame::why_not(bytes, error))?.layer_data.channel_data.pixels)
}
