//! The streams of the pm programs: photons, gather queries and access traces.
//!
//! A stream is a header (what it is about, where it came from), blocks of records, and an end block that proves that it
//! is whole. `README.md` specifies the bytes. This library knows no scene, no photon map and no cache.
//!
//! ```
//! use pm_formats::{BlockMeta, Header, Photon, RecordReader, RecordWriter};
//!
//! let photon = Photon::new([0.0, 0.5, 0.0], [1.0, 0.9, 0.8], [0.5; 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
//! let mut writer = RecordWriter::new(Vec::new(), &Header::empty())?;
//! writer.write(BlockMeta::default(), &[photon])?;
//! let stream = writer.finish(vec![])?; // the only way to an end block
//!
//! let mut reader = RecordReader::<Photon, _>::new(&stream[..])?;
//! while let Some((_, photons)) = reader.next_block()? {
//!     assert_eq!(photons, [photon]);
//! }
//! assert_eq!(reader.end()?.tally.records, 1);
//!
//! // Without its last byte the stream is not whole, and says so.
//! let mut reader = RecordReader::<Photon, _>::new(&stream[..stream.len() - 1])?;
//! reader.next_block()?;
//! assert!(reader.next_block().is_err());
//! # Ok::<(), pm_formats::Error>(())
//! ```

mod beside;
mod container;
mod digest;
mod error;
mod history;
mod parts;
mod record;
mod region;
mod stream;
pub mod trace;
pub mod vocabulary;

pub use beside::{
    IrradianceRay, IrradianceRecord, PixelWeight, decode_irradiance, decode_weights, encode_irradiance, encode_weights,
    tally_beside,
};
pub use container::{
    Block, BlockMeta, BlockReader, BlockWriter, Bounds, Compression, End, FORMAT_VERSION, Header, MAGIC, MAX_BLOCK,
    MAX_PIXELS, Material, Number, Section, StageReport, StreamKind,
};
pub use digest::{Digest, Tally};
pub use error::{Error, Result};
pub use history::{Step, as_commands};
pub use parts::{Parts, PartsError, each_part_once, part_of, whole_header};
pub use record::{
    BLOCK_RECORDS, Photon, Query, Record, UnroundedPhoton, decode_checked, decode_records, encode_records,
    pack_direction, pack_rgbe, unpack_direction, unpack_rgbe,
};
pub use stream::{RecordReader, RecordWriter};
