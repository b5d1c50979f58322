//! Pictures: linear OpenEXR for measuring, PNG for looking.

mod compare;
mod describe;
mod flip;
mod regions;
mod sheet;

pub use compare::{Comparison, REL_MSE_EPSILON};
pub use describe::{Channel, Description};
pub use flip::{HdrFlip, PIXELS_PER_DEGREE, hdr_flip, ldr_flip};
pub use regions::{Region, RegionMean};
pub use sheet::{Preview, contact_sheet};

use anyhow::{Context as _, ensure};
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder,
    Text, WritableImage as _, read_first_rgba_layer_from_file,
};
use std::io::{Cursor, Write};
use std::path::Path;

/// A picture in linear Rec. 709 RGB, row by row from the upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Radiance of each pixel.
    pub pixels: Vec<[f32; 3]>,
}

impl Picture {
    /// A black picture.
    #[must_use]
    pub fn black(size: [u32; 2]) -> Self {
        Self { size, pixels: vec![[0.0; 3]; size[0] as usize * size[1] as usize] }
    }

    /// Writes the picture in the format that the ending of `path` names, `.exr` or `.png`. Into the former go the name and version
    /// of the software that made it, and attributes as comments.
    ///
    /// # Errors
    /// For another ending, or if it cannot be written.
    pub fn write(
        &self,
        path: &Path,
        output: &mut impl Write,
        software: &str,
        attributes: &[(&str, String)],
    ) -> anyhow::Result<()> {
        let bytes = match Format::of(path)? {
            Format::Exr => self.to_exr(software, attributes)?,
            Format::Png => encode_png(self.size, self.preview().pixels.as_flattened())?,
        };
        output.write_all(&bytes)?;
        Ok(())
    }

    fn to_exr(&self, software: &str, attributes: &[(&str, String)]) -> anyhow::Result<Vec<u8>> {
        let channel = |index: usize, name: &str| {
            let samples = self.pixels.iter().map(|pixel| pixel[index]).collect();
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
        let size = (self.size[0] as usize, self.size[1] as usize);
        let image = Image::from_layer(Layer::new(size, layer, encoding, channels));
        let mut bytes = Cursor::new(vec![]);
        image.write().non_parallel().to_buffered(&mut bytes).context("the EXR image cannot be encoded")?;
        Ok(bytes.into_inner())
    }

    /// As a screen shows it: clipped to [0, 1] and through the sRGB curve, 8 bits. Values stay comparable between pictures.
    #[must_use]
    pub fn preview(&self) -> Preview {
        Preview { size: self.size, pixels: self.pixels.iter().map(|pixel| pixel.map(srgb)).collect() }
    }

    /// Reads an EXR image with channels R, G, B.
    ///
    /// # Errors
    /// If there is none at `path`.
    pub fn read_exr(path: &Path) -> anyhow::Result<Self> {
        let image = read_first_rgba_layer_from_file(
            path,
            |size, _| Self::black([size.width() as u32, size.height() as u32]),
            |picture, at, (r, g, b, _): (f32, f32, f32, f32)| {
                let index = at.y() * picture.size[0] as usize + at.x();
                picture.pixels[index] = [r, g, b];
            },
        );
        let image = image.with_context(|| format!("{} is no readable EXR image", path.display()))?;
        Ok(image.layer_data.channel_data.pixels)
    }

    /// Adds another picture of the same size.
    ///
    /// # Errors
    /// If the sizes differ.
    pub fn add(&mut self, other: &Self) -> anyhow::Result<()> {
        let [[w, h], [v, g]] = [self.size, other.size];
        ensure!(self.size == other.size, "the base image is {v}x{g}, but the queries are of a {w}x{h} image");
        for (pixel, base) in self.pixels.iter_mut().zip(&other.pixels) {
            for channel in 0..3 {
                pixel[channel] += base[channel];
            }
        }
        Ok(())
    }

    /// The picture as a camera sees it that takes 2^`stops` of the light.
    #[must_use]
    pub fn exposed(&self, stops: f32) -> Self {
        let scale = libm::exp2f(stops);
        Self { size: self.size, pixels: self.pixels.iter().map(|pixel| pixel.map(|x| x * scale)).collect() }
    }

    /// Share of pixels that a PNG shows too dark because a channel exceeds 1.
    #[must_use]
    pub fn clipped(&self) -> f64 {
        let clipped = self.pixels.iter().filter(|pixel| pixel.iter().any(|&x| x > 1.0)).count();
        clipped as f64 / self.pixels.len().max(1) as f64
    }
}

/// Formats that pictures are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// OpenEXR, linear, 32-bit float.
    Exr,
    /// PNG, 8 bits, sRGB.
    Png,
}

/// A name that does not say which format a picture is to have.
#[derive(Debug, thiserror::Error)]
#[error("{0}: an image's name ends in .exr or .png")]
pub struct UnknownEnding(String);

impl Format {
    /// The format that the ending of a file name asks for.
    ///
    /// # Errors
    /// If it is neither `.exr` nor `.png`.
    pub fn of(path: &Path) -> anyhow::Result<Self> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("exr") => Ok(Self::Exr),
            Some("png") => Ok(Self::Png),
            _ => Err(UnknownEnding(path.display().to_string()).into()),
        }
    }
}

/// A PNG of 8-bit sRGB samples.
fn encode_png(size: [u32; 2], data: &[u8]) -> anyhow::Result<Vec<u8>> {
    let mut bytes = vec![];
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().context("the PNG image cannot be encoded")?;
    writer.write_image_data(data).context("the PNG image cannot be encoded")?;
    writer.finish().context("the PNG image cannot be encoded")?;
    Ok(bytes)
}

/// IEC 61966-2-1, to 8 bits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to [0, 1]")]
fn srgb(x: f32) -> u8 {
    let x = x.clamp(0.0, 1.0);
    let y = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::powf(x, 1.0 / 2.4) - 0.055 };
    (y * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        let pixels = (0..12u8).map(|i| [f32::from(i) * 0.1, 1e-6, f32::from(i) * 7e4]).collect();
        Picture { size: [4, 3], pixels }
    }

    #[test]
    fn exr_keeps_every_bit_and_equal_pictures_are_equal_files() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.exr");
        let write = || {
            let mut bytes = vec![];
            picture().write(&path, &mut bytes, "pm", &[("photonmap.k", "100".into())]).unwrap();
            bytes
        };
        std::fs::write(&path, write()).unwrap();
        assert_eq!(Picture::read_exr(&path).unwrap(), picture());
        assert_eq!(write(), write());
    }

    #[test]
    fn the_curve_is_srgb() {
        // From the standard: 0 and 1 stay, linear 0.2159 is 128, the toe is 12.92 x.
        assert_eq!([0.0, 1.0, 0.215_861, 0.002, 5.0, -1.0, f32::NAN].map(srgb), [0, 255, 128, 7, 255, 0, 0]);
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
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.exr");
        let mut bytes = vec![];
        picture().write(&path, &mut bytes, "pm", &[("photonmap.k", "100".into())]).unwrap();
        std::fs::write(&path, bytes).unwrap();
        let description = Description::read(&path).unwrap();
        assert_eq!(description.size, [4, 3]);
        // Channels stand in alphabetical order: B, G, R.
        let names: Vec<_> = description.channels.iter().map(|channel| &*channel.name).collect();
        assert_eq!(names, ["B", "G", "R"]);
        let blue = &description.channels[0];
        assert_eq!((blue.min, blue.mean, blue.max, blue.not_finite), (0.0, 385_000.0, 770_000.0, 0));
        assert!(description.attributes.contains(&("comments".into(), "photonmap.k = 100".into())));
    }

    #[test]
    fn other_endings_are_refused() {
        assert!(Format::of(Path::new("x.jpg")).is_err());
        assert!(Format::of(Path::new("exr")).is_err());
        assert_eq!(Format::of(Path::new("a.EXR")).unwrap(), Format::Exr);
    }
}
