//! Pictures: linear OpenEXR for measuring, PNG for looking; how two of them differ; many on a sheet.
//!
//! ```
//! use pm_pictures::{Comparison, Picture, PictureFormat};
//!
//! let black = Picture::black([4, 3]);
//! let bytes = black.encode(PictureFormat::Exr, "an example", &[])?;
//! assert_eq!(Comparison::new(&black, &Picture::decode_exr(&bytes)?)?.differing, 0);
//! # Ok::<(), pm_pictures::PictureError>(())
//! ```

mod compare;
mod describe;
mod difference;
mod error;
mod exr_image;
mod file;
mod flip;
mod format;
mod frame;
mod picture;
mod png_image;
mod preview;
mod region;
mod regions;
mod sheet;
mod size;

pub use compare::{Comparison, REL_MSE_EPSILON};
pub use describe::{Channel, Description};
pub use difference::{absolute_difference, heat};
pub use error::{PictureError, Result};
pub use flip::{HdrFlip, PIXELS_PER_DEGREE, hdr_flip, ldr_flip, ldr_flip_map};
pub use format::PictureFormat;
pub use frame::Frame;
pub use picture::Picture;
pub use preview::Preview;
pub use region::Region;
pub use regions::RegionMean;
pub use sheet::contact_sheet;

use size::check_size;
