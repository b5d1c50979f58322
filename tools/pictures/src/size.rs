//! How large a picture may be.

use crate::{PictureError, Result};

/// Most pixels of a picture that is read: 16,384 across and down, three gibibytes.
const MOST_PIXELS: u64 = 1 << 28;

/// Refuses a size before anything is allocated for it.
pub(crate) fn check_size(size: [u64; 2]) -> Result<()> {
    match size[0].checked_mul(size[1]) {
        Some(pixels) if pixels <= MOST_PIXELS => Ok(()),
        _ => Err(PictureError::TooLarge(size)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Picture, PictureFormat, Preview};

    #[test]
    fn what_claims_to_be_huge_is_refused_unread() {
        // PNG: signature, then IHDR with width and height at 16 and 20, and the checksum of its 17 bytes.
        let mut bytes = Picture::black([4, 3]).encode(PictureFormat::Png, "", &[]).unwrap();
        bytes[16..20].copy_from_slice(&100_000u32.to_be_bytes());
        bytes[20..24].copy_from_slice(&100_000u32.to_be_bytes());
        let mut sum = !0u32;
        for &byte in &bytes[12..29] {
            sum ^= u32::from(byte);
            (0..8).for_each(|_| sum = (sum >> 1) ^ if sum & 1 == 1 { 0xEDB8_8320 } else { 0 });
        }
        bytes[29..33].copy_from_slice(&(!sum).to_be_bytes());
        let error = Preview::decode(PictureFormat::Png, &bytes, 0.0).unwrap_err();
        assert!(matches!(error, PictureError::TooLarge([100_000, 100_000])), "{error}");

        // EXR: x0, y0, x1, y1 of the data window behind its name, its type and the length of a box.
        let mut bytes = Picture::black([4, 3]).encode(PictureFormat::Exr, "", &[]).unwrap();
        let name = b"dataWindow\0box2i\0";
        let at = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len() + 4;
        bytes[at + 8..at + 12].copy_from_slice(&99_999i32.to_le_bytes());
        bytes[at + 12..at + 16].copy_from_slice(&99_999i32.to_le_bytes());
        let error = Picture::decode_exr(&bytes).unwrap_err();
        assert!(matches!(error, PictureError::TooLarge([100_000, 100_000])), "{error}");
    }
}
