//! A contact sheet: pictures beside one another, each with its name.

use crate::{PictureError, Preview, Result, png_image};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// Around pictures and between them, in pixels.
const GAP: usize = 12;
/// Height of a label, and its distance from the picture above, in pixels.
const LABEL: RasterHeight = RasterHeight::Size16;
const LABEL_GAP: usize = 4;
/// Grey of the paper and of the labels.
const PAPER: u8 = 24;
const INK: u8 = 230;

/// Puts named pictures into rows, as near to a square as can be, and writes them as a PNG.
///
/// # Errors
/// If there is none, or the sheet cannot be encoded.
pub fn contact_sheet(pictures: &[(String, Preview)]) -> Result<Vec<u8>> {
    if pictures.is_empty() {
        return Err(PictureError::EmptySheet);
    }
    let largest = |axis: usize| pictures.iter().map(|(_, p)| p.size[axis] as usize).max().unwrap_or(0);
    let (width, height) = (largest(0), largest(1));
    let columns = (1..).find(|n| n * n >= pictures.len()).unwrap_or(1);
    let rows = pictures.len().div_ceil(columns);
    let (step, fall) = (width + GAP, height + LABEL_GAP + LABEL.val() + GAP);
    let size = [columns * step + GAP, rows * fall + GAP];
    let mut sheet = vec![[PAPER; 3]; size[0] * size[1]];
    for (index, (name, picture)) in pictures.iter().enumerate() {
        let at = [GAP + index % columns * step, GAP + index / columns * fall];
        let [w, h] = picture.size.map(|x| x as usize);
        // In the middle of its place, down at the label.
        let left = at[0] + (width - w) / 2;
        for (y, row) in picture.pixels.chunks_exact(w.max(1)).enumerate() {
            let from = (at[1] + height - h + y) * size[0] + left;
            sheet[from..from + w].copy_from_slice(row);
        }
        write_label(&mut sheet, size[0], [at[0], at[1] + height + LABEL_GAP], width, name);
    }
    let bytes: Vec<u8> = sheet.into_iter().flatten().collect();
    png_image::encode(size.map(|x| u32::try_from(x).unwrap_or(u32::MAX)), &bytes)
}

/// Writes a name in the middle of a place of a sheet; what does not fit in is left out.
fn write_label(sheet: &mut [[u8; 3]], sheet_width: usize, at: [usize; 2], width: usize, name: &str) {
    let advance = get_raster_width(FontWeight::Regular, LABEL);
    let letters: Vec<char> = name.chars().take(width / advance).collect();
    let left = at[0] + (width - letters.len() * advance) / 2;
    for (index, &letter) in letters.iter().enumerate() {
        let drawn = |c| get_raster(c, FontWeight::Regular, LABEL);
        let Some(drawn) = drawn(letter).or_else(|| drawn('?')) else { continue };
        for (y, row) in drawn.rows().enumerate() {
            for (x, &covered) in row.iter().enumerate() {
                let mix = u16::from(PAPER) + (u16::from(INK - PAPER) * u16::from(covered)) / 255;
                #[expect(clippy::cast_possible_truncation, reason = "at most INK")]
                let grey = mix as u8;
                sheet[(at[1] + y) * sheet_width + left + index * advance + x] = [grey; 3];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(size: [u32; 2], colour: [u8; 3]) -> Preview {
        Preview { size, pixels: vec![colour; (size[0] * size[1]) as usize] }
    }

    #[test]
    fn every_picture_is_on_the_sheet_once_above_its_name() {
        let colours = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0], [0, 255, 255]];
        let sizes = [[40, 30], [40, 30], [20, 30], [40, 10], [7, 5]];
        let pictures: Vec<(String, Preview)> =
            colours.iter().zip(sizes).map(|(&c, size)| ("ab".into(), plain(size, c))).collect();
        let sheet = Preview::decode(crate::PictureFormat::Png, &contact_sheet(&pictures).unwrap(), 0.0).unwrap();
        // Three columns and two rows.
        assert_eq!(sheet.size, [3 * (40 + 12) + 12, 2 * (30 + 4 + 16 + 12) + 12]);
        for (colour, [w, h]) in colours.into_iter().zip(sizes) {
            let found = sheet.pixels.iter().filter(|&&pixel| pixel == colour).count();
            assert_eq!(found, (w * h) as usize, "{colour:?}");
        }
        // Bright letters under the first, none under the place that is empty.
        let row = sheet.size[0] as usize;
        let ink = |column: usize, line: usize| {
            let rows = (0..16).map(|y| (12 + line * 62 + 34 + y) * row + 12 + column * 52);
            rows.flat_map(|from| &sheet.pixels[from..from + 40]).filter(|pixel| pixel[0] > 150).count()
        };
        assert!(ink(0, 0) > 10 && ink(1, 1) > 10 && ink(2, 1) == 0);
    }

    #[test]
    fn long_names_stay_in_their_place() {
        let pictures = [("a-name-that-is-longer-than-its-picture".into(), plain([30, 8], [9; 3]))];
        assert!(contact_sheet(&pictures).is_ok());
        assert!(contact_sheet(&[]).is_err());
    }
}
