//! Bare addresses, little-endian.

use super::{Parsed, READ, Reference};

fn read(address: u64) -> Parsed {
    Ok(Some(Reference { kind: READ, address, len: None }))
}

pub(super) fn parse_32(bytes: &[u8]) -> Parsed {
    read(u32::from_le_bytes(bytes.try_into().expect("four bytes")).into())
}

pub(super) fn parse_64(bytes: &[u8]) -> Parsed {
    read(u64::from_le_bytes(bytes.try_into().expect("eight bytes")))
}
