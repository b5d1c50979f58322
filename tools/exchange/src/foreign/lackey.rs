//! What `valgrind --tool=lackey --trace-mem=yes` prints: ` L 1ffeffe7e,8`, S for stores, M for a load and a store of the
//! same place by one instruction, `I  04016b80,3` for instructions; address hexadecimal, size decimal.
//!
//! M is one access that reads and writes: one line access, a miss at most once, and the line turns dirty. Valgrind's own
//! lines (`==pid==`, `--pid--`, `**pid**`) and empty ones are passed over.

use super::numbers::{hexadecimal, number, quoted, size};
use super::{Kind, MODIFY, Parsed, READ, Reference, WRITE};

pub(super) fn parse(line: &[u8]) -> Parsed {
    let text = line.trim_ascii();
    if text.is_empty() || [b"==", b"--", b"**"].iter().any(|banner| text.starts_with(*banner)) {
        return Ok(None);
    }
    let wrong = || format!("{} is no line of lackey, such as ` L 1ffeffe7e,8`", quoted(line));
    let (&letter, rest) = text.split_first().ok_or_else(wrong)?;
    let kind = match letter {
        b'I' => Kind::Instruction,
        b'L' => READ,
        b'S' => WRITE,
        b'M' => MODIFY,
        _ => return Err(wrong()),
    };
    let comma = rest.iter().position(|&byte| byte == b',').ok_or_else(wrong)?;
    if !rest.starts_with(b" ") || rest[comma + 1..].starts_with(b"0x") {
        return Err(wrong());
    }
    let address = hexadecimal(rest[..comma].trim_ascii())?;
    Ok(Some(Reference { kind, address, len: Some(size(number(&rest[comma + 1..])?)?) }))
}
