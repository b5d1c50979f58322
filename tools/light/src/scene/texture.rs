//! Textures, as far as they go here: the mean colour of an image.

use super::files::Files;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Mean colour of an image, linear red, green, blue; or why there is none, in a few words.
pub(crate) type Texture = Result<[f32; 3], String>;

/// The mean colour of the image that a `map_Kd` statement of the library `mtl` names. Images are read once.
pub(crate) fn mean_colour(
    mtl: &Path,
    statement: &str,
    files: &dyn Files,
    known: &mut HashMap<PathBuf, Texture>,
) -> Texture {
    let name = file_name(statement).replace('\\', "/");
    // Exporters write paths of the machine they ran on: the image is often beside the library all the same.
    let bare = name.rsplit('/').next().unwrap_or(&name);
    let places = [&name, bare].map(|name| mtl.with_file_name("").join(name));
    if let Some(texture) = places.iter().find_map(|path| known.get(path)) {
        return texture.clone();
    }
    let found = places.iter().find_map(|path| files.read(path).ok().map(|bytes| (path.clone(), bytes)));
    let (path, texture) = match found {
        Some((path, bytes)) => (path, mean(&bytes)),
        None => (places[0].clone(), Err(format!("{bare:?} cannot be read"))),
    };
    known.insert(path, texture.clone());
    texture
}

/// What is left of a `map_Kd` statement without its options.
fn file_name(statement: &str) -> &str {
    let mut rest = statement.trim();
    while let Some(option) = rest.split_whitespace().next().filter(|word| word.starts_with('-') && rest != *word) {
        rest = rest[option.len()..].trim_start();
        // Options take one word, or up to three numbers.
        let (words, most) = match option {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (1, 2),
            _ => (1, 1),
        };
        for i in 0..most {
            let word = rest.split_whitespace().next().unwrap_or("");
            if word.len() == rest.len() || (i >= words && word.parse::<f32>().is_err()) {
                break;
            }
            rest = rest[word.len()..].trim_start();
        }
    }
    rest
}

fn mean(bytes: &[u8]) -> Texture {
    if bytes.starts_with(b"\x89PNG") {
        return mean_png(bytes).map_err(|error| format!("its PNG: {error}"));
    }
    if bytes.starts_with(&[0xff, 0xd8]) {
        return mean_jpeg(bytes);
    }
    Err("neither PNG nor JPEG".into())
}

/// Row by row: textures can be larger than is good to hold.
fn mean_png(bytes: &[u8]) -> Result<[f32; 3], png::DecodingError> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let channels = reader.output_color_type().0.samples();
    let mut sum = Sum::default();
    // An interlaced image comes as several smaller ones, which hold every pixel once.
    while let Some(row) = reader.next_row()? {
        sum.add(row.data(), channels);
    }
    Ok(sum.mean())
}

fn mean_jpeg(bytes: &[u8]) -> Texture {
    let mut decoder = zune_jpeg::JpegDecoder::new(std::io::Cursor::new(bytes));
    let why = |error: zune_jpeg::errors::DecodeErrors| format!("its JPEG: {error}").replace('\n', " ");
    let pixels = decoder.decode().map_err(why)?;
    let (width, height) = decoder.dimensions().unwrap_or_default();
    let mut sum = Sum::default();
    sum.add(&pixels, pixels.len() / (width * height).max(1));
    Ok(sum.mean())
}

/// Sums of 8-bit sRGB values, made linear.
struct Sum {
    linear: Vec<f64>,
    sum: [f64; 3],
    pixels: f64,
}

impl Default for Sum {
    fn default() -> Self {
        // The curve of IEC 61966-2-1.
        let decode = |i: i32| {
            let x = f64::from(i) / 255.0;
            if x <= 0.04045 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
        };
        Self { linear: (0..256).map(decode).collect(), sum: [0.0; 3], pixels: 0.0 }
    }
}

impl Sum {
    /// Adds pixels of so many channels: grey or colour, perhaps with an alpha, which is ignored.
    fn add(&mut self, bytes: &[u8], channels: usize) {
        for pixel in bytes.chunks_exact(channels.max(1)) {
            for c in 0..3 {
                self.sum[c] += self.linear[usize::from(pixel[if channels < 3 { 0 } else { c }])];
            }
            self.pixels += 1.0;
        }
    }

    fn mean(&self) -> [f32; 3] {
        self.sum.map(|sum| (sum / self.pixels.max(1.0)) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Are options taken for options, and spaces and backslashes for parts of the name?
    #[test]
    fn options_are_no_part_of_the_name() {
        for (statement, name) in [
            ("wood.png", "wood.png"),
            ("-s 1 1 1 c:\\a b.png", "c:\\a b.png"),
            ("-s 2 wood grain.png", "wood grain.png"),
            ("-clamp on -mm 0 1 -o 0.5 0.5 x.jpg", "x.jpg"),
            ("-blendu off 1.png", "1.png"),
            ("-odd", "-odd"),
            ("-s 1 1 1 7", "7"),
        ] {
            assert_eq!(file_name(statement), name, "{statement}");
        }
    }

    /// Is what is no image refused in one line, however it begins?
    #[test]
    fn damaged_images_are_refused() {
        for bytes in
            [&b""[..], b"BM", b"\x89PNG\r\n\x1a\n", b"\x89PNG", &[0xff, 0xd8], &[0xff, 0xd8, 0xff, 0xc0, 0, 9, 9]]
        {
            assert!(mean(bytes).is_err_and(|why| !why.contains('\n')), "{bytes:?}");
        }
    }

    /// Is the mean one of light, not of the numbers in the file? (Half black, half white is 0.5 of the light, and 0.21
    /// if numbers are averaged first.)
    #[test]
    fn mean_is_of_light() {
        for (colour, white) in [(png::ColorType::Rgb, 3), (png::ColorType::Grayscale, 1), (png::ColorType::Rgba, 4)] {
            let mut file = vec![];
            let mut encoder = png::Encoder::new(&mut file, 2, 1);
            encoder.set_color(colour);
            let data: Vec<u8> = [vec![0; white], vec![255; white]].concat();
            encoder.write_header().unwrap().write_image_data(&data).unwrap();
            assert_eq!(mean(&file).unwrap(), [0.5; 3], "{colour:?}");
        }
    }
}
