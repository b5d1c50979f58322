//! The container that all streams share: header, blocks, end block. `README.md` specifies it byte by byte.

mod block;
mod block_header;
mod end;
mod header;
mod kind;
mod order;
mod packing;
mod reader;
mod section;
mod spelling;
mod writer;

pub use block::{Block, Compression};
pub use block_header::MAX_BLOCK;
pub use end::{End, Number, StageReport};
pub use header::{Bounds, Header, Material};
pub use kind::StreamKind;
pub(crate) use packing::{compress_long, content_size, decompress};
pub use reader::BlockReader;
pub use section::{BlockMeta, Section};
pub use writer::BlockWriter;

/// First bytes of every stream. Like PNG's signature it shows text-mode damage: a high byte, CR LF, and a lone LF.
pub const MAGIC: [u8; 8] = *b"\x89PMS\r\n\x1a\n";
/// Version of the format that this library writes. It reads every version so far.
pub const FORMAT_VERSION: u16 = 2;
/// The first version whose end block proves the order of blocks.
const PROVES_ORDER: u16 = 2;
/// Most pixels of an image; a reader believes no more.
pub const MAX_PIXELS: u64 = 1 << 28;
