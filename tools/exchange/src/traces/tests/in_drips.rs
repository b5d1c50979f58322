//! Does it matter in which portions an input comes?

use super::{Heard, plain};
use crate::traces::{Opened, imports};
use pm_formats::trace::Access;
use std::io::{self, BufReader, Read};

/// Gives so many bytes at a time, and is interrupted before each.
struct Dripping {
    bytes: Vec<u8>,
    at: usize,
    portion: usize,
    interrupt: bool,
}

impl Read for Dripping {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.interrupt = !self.interrupt;
        if self.interrupt {
            return Err(io::ErrorKind::Interrupted.into());
        }
        let rest = &self.bytes[self.at..];
        let given = rest.len().min(self.portion).min(buffer.len());
        buffer[..given].copy_from_slice(&rest[..given]);
        self.at += given;
        Ok(given)
    }
}

fn read(bytes: &[u8], portion: usize) -> Result<Vec<Access>, String> {
    let input = Dripping { bytes: bytes.to_vec(), at: 0, portion, interrupt: false };
    let input = BufReader::with_capacity(1 << 17, input);
    let opened = crate::traces::open(input, &plain(Some("oracleGeneral")), &imports()).map_err(|e| e.to_string())?;
    let Opened::Foreign(mut trace) = opened else { return Err("ours".into()) };
    let mut heard = Heard::default();
    trace.replay(&mut heard).map_err(|error| error.to_string())?;
    Ok(heard.0)
}

#[test]
fn records_are_the_same_in_portions_of_any_size() {
    // More than a buffer, and than the beginning by which inputs are known.
    let request =
        |i: u32| [&i.to_le_bytes()[..], &(u64::from(i) << 8).to_le_bytes(), &[16, 0, 0, 0], &[0xff; 8]].concat();
    let bytes: Vec<u8> = (0..20_000).flat_map(request).collect();
    let expected: Vec<Access> = (0..20_000).map(|i| Access::read(0, i << 8, 16)).collect();
    for portion in [7, 24, 1000, 4096, 1 << 20] {
        assert!(read(&bytes, portion) == Ok(expected.clone()), "{portion}");
        let cut = read(&bytes[..bytes.len() - 1], portion).unwrap_err();
        assert!(cut.contains("record 20000: the input ends after 23 of its 24 bytes"), "{cut}");
        let mut long = bytes.clone();
        long[24 * 19_990 + 15] = 0xff;
        let long = read(&long, portion).unwrap_err();
        assert!(long.contains("record 19991: an access of"), "{long}");
        // One that goes on beyond the last address, among many that do not.
        let mut beyond = bytes.clone();
        beyond[24 * 19_980 + 4..][..8].fill(0xff);
        let beyond = read(&beyond, portion).unwrap_err();
        assert!(beyond.contains("record 19981: 16 bytes at address 0xffffffffffffffff"), "{beyond}");
    }
}
