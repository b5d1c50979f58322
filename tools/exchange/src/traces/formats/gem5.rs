//! `gem5`: packets of gem5 as its `util/decode_packet_trace.py` prints them: perhaps the number of the packet; r, w or u;
//! address; bytes; perhaps flags; tick; perhaps the program counter; all decimal between commas.
//!
//! `u` stands for every command that is no plain read or write, such as a write-back: what it does is not told, so such a
//! line is refused.

use crate::traces::text::{number, quoted, size};
use crate::traces::{AssumedSize, EntryKind, EntryParser, Example, Parsed, Reference, TraceImport};

pm_registry::registered! {
    /// gem5's packets as its decode_packet_trace.py prints them: r or w, address, bytes, perhaps flags, tick
    pub struct Gem5 = "gem5";
}

fn parse(line: &[u8]) -> Parsed {
    let wrong = || format!("{} is no packet of gem5, such as `r,4096,64,256,1000`", quoted(line));
    let fields: Vec<&[u8]> = line.split(|&byte| byte == b',').map(<[u8]>::trim_ascii).collect();
    // The number of the packet comes first, if it is told.
    let numbered = fields.first().is_some_and(|field| number(field).is_ok());
    let (letter, address, bytes, rest) = match fields[usize::from(numbered)..] {
        [&[letter], address, bytes, ref rest @ ..] if (1..=3).contains(&rest.len()) => (letter, address, bytes, rest),
        _ => return Err(wrong()),
    };
    let kind = match letter {
        b'r' => EntryKind::READ,
        b'w' => EntryKind::WRITE,
        b'u' => return Err("a packet that neither reads nor writes plainly (u): leave such lines out".into()),
        _ => return Err(wrong()),
    };
    rest.iter().try_for_each(|field| number(field).map(drop))?;
    Ok(Some(Reference { kind, address: number(address)?, len: Some(size(number(bytes)?)?) }))
}

impl TraceImport for Gem5 {
    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"r,4096,64,256,1000\nw,64,4,2000\n17,r,128,8,0,3000,4194304\n",
            entries: &[
                Reference { kind: EntryKind::READ, address: 4096, len: Some(64) },
                Reference { kind: EntryKind::WRITE, address: 64, len: Some(4) },
                Reference { kind: EntryKind::READ, address: 128, len: Some(8) },
            ],
        }
    }
}
