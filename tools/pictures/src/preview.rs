//! A picture as a screen shows it.

/// A picture as a screen shows it: 8 bits, sRGB, row by row from the upper left corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Preview {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Its pixels.
    pub pixels: Vec<[u8; 3]>,
}

/// IEC 61966-2-1, to 8 bits.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to [0, 1]")]
pub(crate) fn srgb(x: f32) -> u8 {
    let x = x.clamp(0.0, 1.0);
    let y = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::powf(x, 1.0 / 2.4) - 0.055 };
    (y * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Picture, PictureFormat};

    #[test]
    fn the_curve_is_srgb() {
        // From the standard: 0 and 1 stay, linear 0.2159 is 128, the toe is 12.92 x.
        assert_eq!([0.0, 1.0, 0.215_861, 0.002, 5.0, -1.0, f32::NAN].map(srgb), [0, 255, 128, 7, 255, 0, 0]);
    }

    #[test]
    fn what_png_was_written_is_read() {
        let picture = Picture { size: [2, 2], pixels: vec![[0.0, 0.215_861, 1.0], [2.0; 3], [0.5; 3], [0.1; 3]] };
        for format in [PictureFormat::Png, PictureFormat::Exr] {
            let bytes = picture.encode(format, "pm", &[]).unwrap();
            assert_eq!(Preview::decode(format, &bytes, 0.0).unwrap(), picture.preview(), "{format:?}");
        }
        assert_eq!(picture.preview().pixels[0], [0, 128, 255]);
    }
}
