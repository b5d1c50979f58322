//! How headers and end blocks are spelled: bincode with fixed-size little-endian integers and a limit.

use crate::error::{Error, Result};
use bincode::config::{Configuration, Fixint, Limit, LittleEndian};
use serde::{Serialize, de::DeserializeOwned};

/// Largest header or end block that is read, in bytes; keeps a damaged length from claiming the memory.
pub(super) const MAX_RECORD: usize = 64 << 20;

const fn configuration() -> Configuration<LittleEndian, Fixint, Limit<MAX_RECORD>> {
    bincode::config::standard().with_little_endian().with_fixed_int_encoding().with_limit::<MAX_RECORD>()
}

pub(super) fn encode<T: Serialize>(value: &T) -> Result<Vec<u8>> {
    bincode::serde::encode_to_vec(value, configuration()).map_err(|error| Error::Invalid(error.to_string()))
}

/// Decodes a value that must fill `bytes` exactly.
pub(super) fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    match bincode::serde::decode_from_slice(bytes, configuration()) {
        Ok((value, used)) if used == bytes.len() => Some(value),
        _ => None,
    }
}
