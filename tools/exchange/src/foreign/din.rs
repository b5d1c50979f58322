//! The text formats of Dinero: `din` of Dinero III and IV, and `xdin` of Dinero IV.
//!
//! Dinero takes the address of a `din` line for that of a word of four bytes. Whatever follows on a line is a comment.
//! Copy-backs and invalidations are instructions to a cache, not accesses, and refused.

use super::numbers::{hexadecimal, quoted, size, words};
use super::{Kind, Parsed, READ, Reference, WRITE};

pub(super) fn parse_din(line: &[u8]) -> Parsed {
    let mut words = words(line);
    let (Some(label), Some(address)) = (words.next(), words.next()) else {
        return Err(format!("{} is not a label and an address", quoted(line)));
    };
    let kind = kind(hexadecimal(label)?)?;
    Ok(Some(Reference { kind, address: hexadecimal(address)?, len: None }))
}

/// The kind by its number, which `dinb` has too.
pub(super) fn kind(label: u64) -> Result<Kind, String> {
    match label {
        0 | 3 => Ok(READ),
        1 => Ok(WRITE),
        2 => Ok(Kind::Instruction),
        4 | 5 => Err(format!("label {label} tells a cache to copy back or to forget, which is not simulated")),
        _ => Err(format!("label {label} is none of 0 (read), 1 (write), 2 (instruction), 3 (other)")),
    }
}

pub(super) fn parse_xdin(line: &[u8]) -> Parsed {
    let mut words = words(line);
    let (Some(label), Some(address), Some(len)) = (words.next(), words.next(), words.next()) else {
        return Err(format!("{} is not a label, an address and a size", quoted(line)));
    };
    let kind = match label {
        b"r" | b"m" => READ,
        b"w" => WRITE,
        b"i" => Kind::Instruction,
        b"c" | b"v" => {
            return Err(format!("label {} tells a cache to copy back or to forget: not simulated", quoted(label)));
        }
        _ => return Err(format!("label {} is none of r, w, i, m", quoted(label))),
    };
    Ok(Some(Reference { kind, address: hexadecimal(address)?, len: Some(size(hexadecimal(len)?)?) }))
}
