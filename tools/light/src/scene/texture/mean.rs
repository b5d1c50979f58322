//! The mean colour of an image file.

use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use std::path::Path;
use std::sync::LazyLock;

#[cfg(test)]
mod tests;

/// Longest side of an image, in texels, and most memory for it: more is refused before it is asked for.
const LONGEST_SIDE: u32 = 1 << 15;
const MOST_BYTES: u64 = 512 << 20;

/// Mean colour of an image, linear red, green, blue; or why there is none, in a few words.
pub(crate) type Texture = Result<[f32; 3], String>;

/// The mean of an image's light, weighted by alpha: what is not seen does not count. The format is known by how the file
/// begins, or else by how it is called.
pub(super) fn mean(path: &Path, bytes: &[u8]) -> Texture {
    // A Targa file begins with nothing to know it by.
    let format = image::guess_format(bytes).or_else(|_| ImageFormat::from_path(path));
    let format = format.map_err(|_| "its format is not known".to_owned())?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_image_width = Some(LONGEST_SIDE);
    limits.max_image_height = Some(LONGEST_SIDE);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let why = |error: image::ImageError| {
        let name = format.extensions_str().first().copied().unwrap_or("image").to_uppercase();
        format!("its {name}: {error}").replace('\n', " ")
    };
    let mut sum = Sum::default();
    match reader.decode().map_err(why)? {
        DynamicImage::ImageLuma8(image) => sum.add(&image, 1, byte),
        DynamicImage::ImageLumaA8(image) => sum.add(&image, 2, byte),
        DynamicImage::ImageRgb8(image) => sum.add(&image, 3, byte),
        DynamicImage::ImageRgba8(image) => sum.add(&image, 4, byte),
        DynamicImage::ImageRgb32F(image) => sum.add_linear(&image, 3),
        DynamicImage::ImageRgba32F(image) => sum.add_linear(&image, 4),
        other => sum.add(&other.into_rgba16(), 4, |word: u16| word),
    }
    sum.mean().ok_or_else(|| "none of it is seen: alpha is 0 everywhere".to_owned())
}

/// A byte on the scale of 16 bits: exactly the same share of the whole.
fn byte(byte: u8) -> u16 {
    u16::from(byte) * 257
}

/// By the number of 16 bits in an sRGB file, the light: the curve of IEC 61966-2-1. All textures have one, as it takes longer than
/// to read a small one.
static LINEAR: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let decode = |i: u16| {
        let x = f64::from(i) / 65535.0;
        if x <= 0.04045 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
    };
    (0..=u16::MAX).map(decode).collect()
});

/// Sums of texels, made linear.
#[derive(Default)]
struct Sum {
    light: [f64; 3],
    alpha: f64,
}

impl Sum {
    /// Adds texels of so many channels: grey or colour, perhaps with an alpha.
    fn add<T: Copy>(&mut self, samples: &[T], channels: usize, scale: impl Fn(T) -> u16) {
        let linear = &**LINEAR;
        for texel in samples.chunks_exact(channels) {
            let alpha = if channels.is_multiple_of(2) { f64::from(scale(texel[channels - 1])) / 65535.0 } else { 1.0 };
            let light = |c: usize| linear[usize::from(scale(texel[if channels < 3 { 0 } else { c }]))];
            self.add_texel([0, 1, 2].map(light), alpha);
        }
    }

    /// Adds texels that hold light and no code for it; what is no number counts as black.
    fn add_linear(&mut self, samples: &[f32], channels: usize) {
        for texel in samples.chunks_exact(channels) {
            let share = |x: f32| f64::from(x.max(0.0)).min(f64::from(f32::MAX));
            let alpha = if channels == 4 { share(texel[3]).min(1.0) } else { 1.0 };
            self.add_texel([0, 1, 2].map(|c| share(texel[c])), alpha);
        }
    }

    fn add_texel(&mut self, light: [f64; 3], alpha: f64) {
        for (sum, light) in self.light.iter_mut().zip(light) {
            *sum += light * alpha;
        }
        self.alpha += alpha;
    }

    /// `None` if nothing is seen.
    fn mean(&self) -> Option<[f32; 3]> {
        (self.alpha > 0.0).then(|| self.light.map(|sum| (sum / self.alpha) as f32))
    }
}
