//! Means of rectangles of a picture: what two renderers that share no noise can be compared by.

use crate::{Picture, PictureError, Region};

/// What a region holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionMean {
    /// x0, y0, x1, y1 of the rectangle.
    pub rectangle: [u32; 4],
    /// Pixels in it.
    pub pixels: u64,
    /// Pixels left out because a channel is infinite or no number.
    pub not_finite: u64,
    /// Mean radiance of the others, by channel; not a number if there are none.
    pub mean: [f64; 3],
}

impl RegionMean {
    /// Measures a region of a picture.
    ///
    /// # Errors
    /// If it reaches beyond the picture.
    pub fn new(picture: &Picture, region: Region) -> Result<Self, PictureError> {
        let [width, height] = picture.size;
        let rectangle = match region {
            Region::All => [0, 0, width, height],
            Region::Rectangle(rectangle) => rectangle,
        };
        let [x0, y0, x1, y1] = rectangle;
        if x1 > width || y1 > height {
            return Err(PictureError::RegionBeyond { region, size: picture.size });
        }
        let (mut sum, mut finite, mut not_finite) = ([0f64; 3], 0u64, 0);
        for y in y0..y1 {
            let row = &picture.pixels[y as usize * width as usize..][x0 as usize..x1 as usize];
            for pixel in row {
                if pixel.iter().all(|x| x.is_finite()) {
                    finite += 1;
                    (0..3).for_each(|channel| sum[channel] += f64::from(pixel[channel]));
                } else {
                    not_finite += 1;
                }
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "pictures have fewer than 2^50 pixels")]
        let mean = sum.map(|sum| sum / finite as f64);
        Ok(Self { rectangle, pixels: finite + not_finite, not_finite, mean })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixel (x, y) is (x, 10 y, 1).
    fn picture() -> Picture {
        let pixels = (0..3u8).flat_map(|y| (0..4u8).map(move |x| [f32::from(x), 10.0 * f32::from(y), 1.0]));
        Picture { size: [4, 3], pixels: pixels.collect() }
    }

    fn region(text: &str) -> Region {
        text.parse().unwrap()
    }

    #[test]
    fn a_rectangle_holds_its_first_pixels_and_not_its_last() {
        let mean = |text: &str| RegionMean::new(&picture(), region(text)).unwrap();
        assert_eq!((mean("1,2,2,3").pixels, mean("1,2,2,3").mean), (1, [1.0, 20.0, 1.0]));
        assert_eq!((mean("1,0,4,2").pixels, mean("1,0,4,2").mean), (6, [2.0, 5.0, 1.0]));
        assert_eq!(mean("all"), mean("0,0,4,3"));
        assert_eq!(mean("all").mean, [1.5, 10.0, 1.0]);
    }

    #[test]
    fn what_is_no_region_is_refused() {
        for text in ["", "1,2,3", "2,0,2,1", "0,1,1,1", "0,0,-1,1", "0,0,1,1,1", "whole"] {
            assert!(text.parse::<Region>().is_err(), "{text}");
        }
        assert!(RegionMean::new(&picture(), region("0,0,5,1")).is_err());
        assert!(RegionMean::new(&picture(), region("0,3,1,4")).is_err());
        assert_eq!(region(&region("1,2,3,4").to_string()), region("1,2,3,4"));
    }

    #[test]
    fn what_is_not_finite_is_counted_and_left_out() {
        let mut picture = picture();
        picture.pixels[0][1] = f32::NAN;
        let found = RegionMean::new(&picture, region("0,0,2,1")).unwrap();
        assert_eq!((found.pixels, found.not_finite, found.mean), (2, 1, [1.0, 0.0, 1.0]));
        assert!(RegionMean::new(&picture, region("0,0,1,1")).unwrap().mean[0].is_nan());
    }
}
