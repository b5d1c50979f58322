//! A picture in linear colours.

use crate::{PictureError, Preview, Result};

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

    /// As a screen shows it: clipped to [0, 1] and through the sRGB curve, 8 bits. Values stay comparable between pictures.
    #[must_use]
    pub fn preview(&self) -> Preview {
        Preview { size: self.size, pixels: self.pixels.iter().map(|pixel| pixel.map(crate::preview::srgb)).collect() }
    }

    /// Adds another picture of the same size.
    ///
    /// # Errors
    /// If the sizes differ.
    pub fn add(&mut self, other: &Self) -> Result<()> {
        if self.size != other.size {
            return Err(PictureError::SizesDiffer(self.size, other.size));
        }
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

#[cfg(test)]
mod tests;
