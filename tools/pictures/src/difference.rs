//! Pictures of how far two pictures differ.

use crate::{Picture, Preview};

/// The absolute difference of two pictures, channel by channel; where one of them is not finite, neither is the difference.
///
/// # Panics
/// If they are not of the same size.
#[must_use]
pub fn absolute_difference(a: &Picture, b: &Picture) -> Picture {
    assert_eq!(a.size, b.size, "pictures of one size are compared");
    let difference = |(a, b): (&[f32; 3], &[f32; 3])| [0, 1, 2].map(|channel: usize| (b[channel] - a[channel]).abs());
    Picture { size: a.size, pixels: a.pixels.iter().zip(&b.pixels).map(difference).collect() }
}

/// Values from 0 to 1 as colours of heat: black, red, yellow, white.
///
/// # Panics
/// If there are not as many values as pixels.
#[must_use]
pub fn heat(size: [u32; 2], values: &[f32]) -> Preview {
    assert_eq!(values.len() as u64, u64::from(size[0]) * u64::from(size[1]), "a value for each pixel");
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    let level = |value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
    Preview { size, pixels: values.iter().map(|x| [0.0, 1.0, 2.0].map(|below| level(3.0 * x - below))).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_goes_from_black_by_red_and_yellow_to_white() {
        let picture = heat([5, 1], &[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0, 7.0]);
        assert_eq!(picture.pixels, [[0, 0, 0], [255, 0, 0], [255, 255, 0], [255, 255, 255], [255, 255, 255]]);
    }

    #[test]
    fn differences_have_no_sign() {
        let picture = |values: [f32; 3]| Picture { size: [1, 1], pixels: vec![values] };
        let difference = absolute_difference(&picture([1.0, 2.0, 3.0]), &picture([3.0, 2.0, 1.5]));
        assert_eq!(difference.pixels, [[2.0, 0.0, 1.5]]);
    }
}
