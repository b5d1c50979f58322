//! What can be wrong with a picture.

/// Why a picture could not be read, written or used.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The bytes are no EXR image.
    #[error("this is no readable EXR image")]
    NotExr(#[source] exr::error::Error),
    /// The EXR image has other channels, which are named.
    #[error("this EXR image has no channels R, G and B; it has {0}")]
    ChannelsMissing(String),
    /// The bytes are no PNG image.
    #[error("this is no readable PNG image")]
    NotPng(#[source] png::DecodingError),
    /// It claims more pixels than any picture of ours may have: width and height.
    #[error("a picture of {}x{} pixels is more than is read, 2^28 pixels", .0[0], .0[1])]
    TooLarge([u64; 2]),
    /// It cannot be made an EXR image.
    #[error("the EXR image cannot be encoded")]
    ExrNotEncoded(#[source] exr::error::Error),
    /// It cannot be made a PNG image.
    #[error("the PNG image cannot be encoded")]
    PngNotEncoded(#[source] png::EncodingError),
    /// They are not of one size: width and height of each.
    #[error(
        "the pictures are of {}x{} and {}x{} pixels; only equal sizes can be compared or added",
        .0[0], .0[1], .1[0], .1[1]
    )]
    SizesDiffer([u32; 2], [u32; 2]),
    /// A region is not inside the picture.
    #[error("region {region} reaches beyond the picture of {}x{} pixels", .size[0], .size[1])]
    RegionBeyond {
        /// The region.
        region: crate::Region,
        /// Width and height of the picture.
        size: [u32; 2],
    },
    /// A region is not inside what there is of a picture.
    #[error("region {region} reaches beyond the pixels that are there, {} of the display window", .there.map(|x| x.to_string()).join(","))]
    BeyondData {
        /// The region.
        region: crate::Region,
        /// x0, y0, x1, y1 of the pixels that are there, counted from the display window.
        there: [i64; 4],
    },
    /// A sheet without pictures.
    #[error("a contact sheet needs pictures")]
    EmptySheet,
}

/// Shorthand for results of this library.
pub type Result<T> = std::result::Result<T, PictureError>;
