//! Transactions for simulators of memory: DRAMsim3 (`0x1000 READ 7`) and Ramulator 2 (`LD 0x1000`).

use super::numbers::{number, quoted, words};
use super::{Parsed, READ, Reference, WRITE};

pub(super) fn parse_dramsim3(line: &[u8]) -> Parsed {
    let wrong = || format!("{} is not an address, READ or WRITE, and a cycle", quoted(line));
    let [address, kind, cycle] = words(line).collect::<Vec<_>>()[..] else { return Err(wrong()) };
    let kind = match kind {
        b"READ" => READ,
        b"WRITE" => WRITE,
        _ => return Err(wrong()),
    };
    number(cycle)?;
    Ok(Some(Reference { kind, address: number(address)?, len: None }))
}

pub(super) fn parse_ramulator2(line: &[u8]) -> Parsed {
    let wrong = || format!("{} is not LD or ST and an address", quoted(line));
    let [kind, address] = words(line).collect::<Vec<_>>()[..] else { return Err(wrong()) };
    let kind = match kind {
        b"LD" => READ,
        b"ST" => WRITE,
        _ => return Err(wrong()),
    };
    Ok(Some(Reference { kind, address: number(address)?, len: None }))
}
