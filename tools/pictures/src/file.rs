//! Pictures as files of either format.

use crate::{Picture, PictureFormat, Preview, Result, exr_image, png_image};

impl Picture {
    /// The picture as a file of this format. Into EXR go the name and version of the software that made it, and attributes
    /// as comments.
    ///
    /// # Errors
    /// If it cannot be encoded.
    pub fn encode(&self, format: PictureFormat, software: &str, attributes: &[(&str, String)]) -> Result<Vec<u8>> {
        match format {
            PictureFormat::Exr => exr_image::encode(self, software, attributes),
            PictureFormat::Png => self.preview().encode_png(),
        }
    }

    /// The picture in the bytes of an EXR file with channels R, G, B.
    ///
    /// # Errors
    /// If there is none.
    pub fn decode_exr(bytes: &[u8]) -> Result<Self> {
        exr_image::decode(bytes)
    }
}

impl Preview {
    /// The preview in the bytes of a PNG file, or made of the picture in an EXR file, brightened by so many stops.
    ///
    /// # Errors
    /// If there is no such picture.
    pub fn decode(format: PictureFormat, bytes: &[u8], stops: f32) -> Result<Self> {
        match format {
            PictureFormat::Exr => Ok(Picture::decode_exr(bytes)?.exposed(stops).preview()),
            PictureFormat::Png => png_image::decode(bytes),
        }
    }

    /// A PNG file.
    ///
    /// # Errors
    /// If it cannot be encoded.
    pub fn encode_png(&self) -> Result<Vec<u8>> {
        png_image::encode(self.size, self.pixels.as_flattened())
    }
}
