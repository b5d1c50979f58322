//! Pictures of a page.

use super::PictureBlock;
use super::html::data_uri;
use crate::ReportError;
use crate::sheet::Sheets;
use minijinja::{Value, context};

/// What the template of a picture needs; `alt` is text, `caption` HTML.
///
/// # Errors
/// If there is no such PNG file, or nothing says what it shows.
pub(super) fn block(
    block: &PictureBlock,
    (alt, caption): (String, Value),
    command: Option<&str>,
    sheets: &Sheets,
) -> Result<Value, ReportError> {
    let bytes = sheets.bytes(&block.file)?;
    let (width, height) =
        png_size(&bytes).ok_or_else(|| ReportError::read(format!("{}: this is not a PNG file", block.file)))?;
    if alt.trim().is_empty() {
        return Err(ReportError::asked("`alt` says what the picture shows, for those who do not see it"));
    }
    Ok(context! {
        template => "picture.html",
        id => block.id.as_deref(),
        source => data_uri("image/png", &bytes),
        alt,
        width,
        height,
        caption,
        command,
    })
}

/// Width and height of a PNG file.
fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    (bytes.starts_with(b"\x89PNG\r\n\x1a\n") && bytes.get(12..16)? == b"IHDR").then_some(())?;
    Some((number(16)?, number(20)?))
}
