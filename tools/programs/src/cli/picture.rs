//! Pictures in files, whose format is known by their names.

use super::usage::usage;
use super::{claims, named, software};
use anyhow::Context as _;
use pm_formats::vocabulary::Part;
use pm_pictures::{Description, Frame, Picture, PictureError, PictureFormat, Preview};
use std::fs;
use std::io::Write;
use std::path::Path;

/// The format that the ending of a file's name asks for.
///
/// # Errors
/// If it is neither `.exr` nor `.png`.
pub fn picture_format(path: &Path) -> anyhow::Result<PictureFormat> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let format = PictureFormat::of_ending(&ending);
    format.ok_or_else(|| usage(format!("{}: an image's name ends in .exr or .png", path.display())))
}

/// The attribute of a picture of which other parts are to be added.
pub const PART: &str = "photonmap.part";

/// The attribute of a picture that tells number and digest of the queries it was made of.
pub const QUERIES: &str = "photonmap.queries";

/// What a picture of ours says of itself, name by name, in the order in which it was written.
///
/// # Errors
/// If there is none.
pub fn picture_says(path: &Path) -> anyhow::Result<Vec<(String, String)>> {
    let comments = describe_picture(path)?.attributes.into_iter().find(|(name, _)| name == "comments");
    let line = |line: &str| line.split_once(" = ").map(|(name, value)| (name.to_owned(), value.to_owned()));
    Ok(comments.iter().flat_map(|(_, text)| text.lines()).filter_map(line).collect())
}

/// The format of a picture that may be a part of one: only EXR says so.
///
/// # Errors
/// As [`picture_format`], and for a preview of a part.
pub fn check_part_of_picture(path: &Path, part: Option<Part>) -> anyhow::Result<PictureFormat> {
    let format = picture_format(path)?;
    match part {
        Some(part) if format != PictureFormat::Exr => Err(usage(format!(
            "{}: part {part} makes a part of a picture, and only an .exr says so; pm-view --merge puts them together",
            path.display()
        ))),
        _ => Ok(format),
    }
}

/// Writes a picture in the format that its name asks for; into EXR go the version of our programs, and attributes.
///
/// # Errors
/// If it asks for none, or the picture cannot be written.
pub fn write_picture(
    picture: &Picture,
    path: &Path,
    output: &mut impl Write,
    attributes: &[(&str, String)],
) -> anyhow::Result<()> {
    let bytes = picture.encode(picture_format(path)?, &software(), attributes)?;
    Ok(output.write_all(&bytes)?)
}

/// Reads a picture in EXR, and where its pixels lie.
///
/// # Errors
/// If there is none.
pub fn read_framed(path: &Path) -> anyhow::Result<(Picture, Frame)> {
    let bytes = bytes(path)?;
    let read = || Ok::<_, PictureError>((Picture::decode_exr(&bytes)?, Frame::of_exr(&bytes)?));
    read().with_context(|| named(path))
}

/// Reads what an EXR file says of itself.
///
/// # Errors
/// If there is none.
pub fn describe_picture(path: &Path) -> anyhow::Result<Description> {
    Description::of_exr(&bytes(path)?).with_context(|| named(path))
}

/// Reads a preview in PNG, or makes one of a picture in EXR, brightened by so many stops.
///
/// # Errors
/// If there is no such picture.
pub fn read_preview(path: &Path, stops: f32) -> anyhow::Result<Preview> {
    Preview::decode(picture_format(path)?, &bytes(path)?, stops).with_context(|| named(path))
}

fn bytes(path: &Path) -> anyhow::Result<Vec<u8>> {
    claims::read(path)?;
    fs::read(path).with_context(|| named(path))
}
