//! The binary format of Dinero IV: address u32, size u16, label u8 as in `din`, and a byte that says nothing.

use super::{Parsed, Reference, din};

pub(super) const BYTES: usize = 8;

pub(super) fn parse(bytes: &[u8]) -> Parsed {
    Ok(Some(Reference {
        kind: din::kind(bytes[6].into())?,
        address: u32::from_le_bytes(bytes[..4].try_into().expect("four bytes")).into(),
        len: Some(u16::from_le_bytes([bytes[4], bytes[5]]).into()),
    }))
}

/// A record, unless the address or the size is beyond the format.
pub(super) fn record(address: u64, len: u32, write: bool) -> Option<[u8; BYTES]> {
    let mut bytes = [0; BYTES];
    bytes[..4].copy_from_slice(&u32::try_from(address).ok()?.to_le_bytes());
    bytes[4..6].copy_from_slice(&u16::try_from(len).ok()?.to_le_bytes());
    bytes[6] = write.into();
    Some(bytes)
}
