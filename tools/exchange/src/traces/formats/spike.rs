//! `spike`: what the RISC-V simulator of that name logs of each instruction with `--log-commits` (`riscv/execute.cc`):
//! `core   0: 3 0x80000048 (0x00c5b023) mem 0x80002000 0x0000000000000001`.
//!
//! Behind core, privilege, address and code of the instruction stand registers that change, and for each access `mem`, its
//! address, and for a write the value, whose digits tell the bytes; those of a read the code of the instruction tells.
//! Lines of `-l` and others that begin with a core or `>>>>` are passed over.

mod width;

use crate::traces::text::{hexadecimal, quoted, words};
use crate::traces::{AssumedSize, EntryKind, EntryParser, Example, Parsed, Reference, TraceImport};
use std::collections::VecDeque;

pm_registry::registered! {
    /// Spike with --log-commits: core, privilege, instruction, registers, and mem with each address
    pub struct Spike = "spike";
}

#[derive(Default)]
struct Parser {
    rest: VecDeque<Reference>,
    committed: u64,
    passed_over: u64,
}

impl EntryParser for Parser {
    fn parse(&mut self, line: &[u8]) -> Parsed {
        self.rest.clear();
        let words: Vec<&[u8]> = words(line).collect();
        let wrong = || format!("{} is no line of spike --log-commits", quoted(line));
        let (privilege, instruction, code, rest) = match words[..] {
            [b"core", core, &[privilege], instruction, code, ref rest @ ..] if core.ends_with(b":") => {
                (privilege, instruction, code, rest)
            }
            [b"core", core, ..] if core.ends_with(b":") => {
                self.passed_over += 1;
                return Ok(None);
            }
            [b">>>>", ..] => return Ok(None),
            _ => return Err(wrong()),
        };
        let bits = code.strip_prefix(b"(").and_then(|code| code.strip_suffix(b")"));
        let (true, Some(bits)) = (privilege.is_ascii_digit(), bits) else { return Err(wrong()) };
        let code = hexadecimal(bits)?;
        let mut rest = rest;
        while let [word, after @ ..] = rest {
            rest = after;
            if *word != b"mem" {
                continue;
            }
            let [address, after @ ..] = rest else { return Err(wrong()) };
            let address = hexadecimal(address)?;
            match after {
                [value, after @ ..] if value.starts_with(b"0x") => {
                    rest = after;
                    let len = Some((value.len() as u32 - 2).div_ceil(2));
                    self.rest.push_back(Reference { kind: EntryKind::WRITE, address, len });
                }
                _ => {
                    rest = after;
                    let len = width::of_load(code);
                    self.rest.push_back(Reference { kind: EntryKind::READ, address, len });
                }
            }
        }
        self.committed += 1;
        // Compressed instructions have two bytes.
        let len = Some((bits.len() as u32).saturating_sub(2) / 2);
        Ok(Some(Reference { kind: EntryKind::Instruction, address: hexadecimal(instruction)?, len }))
    }

    fn rest(&mut self) -> Option<Reference> {
        self.rest.pop_front()
    }

    fn end(&mut self) -> Result<(), String> {
        if self.committed == 0 && self.passed_over > 0 {
            return Err("no instruction with its accesses: run spike with --log-commits".into());
        }
        Ok(())
    }
}

impl TraceImport for Spike {
    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize::bytes(8))
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::<Parser>::default()
    }

    fn example(&self) -> Example {
        const fn instruction(address: u64, len: u32) -> Reference {
            Reference { kind: EntryKind::Instruction, address, len: Some(len) }
        }
        Example {
            input: b"core   0: 0x0000000080000044 (0x0005a503) lw      a0, 0(a1)\n\
                core   0: 3 0x0000000080000044 (0x0005a503) x10 0x0000000000000007 mem 0x0000000080002004\n\
                core   0: 3 0x0000000080000048 (0x00c5b023) mem 0x0000000080002000 0x0000000000000001\n\
                core   0: 3 0x000000008000004c (0x6588) x10 0x0000000000000001 mem 0x0000000080002008\n\
                core   0: 3 0x000000008000004e (0x00a5a52f) x10 0x0000000000000001 mem 0x0000000080002010 mem 0x0000000080002010 0x00000002\n\
                core   0: exception trap_load_page_fault, epc 0x0000000080000052\n",
            entries: const {
                &[
                    instruction(0x8000_0044, 4),
                    Reference { kind: EntryKind::READ, address: 0x8000_2004, len: Some(4) },
                    instruction(0x8000_0048, 4),
                    Reference { kind: EntryKind::WRITE, address: 0x8000_2000, len: Some(8) },
                    instruction(0x8000_004c, 2),
                    Reference { kind: EntryKind::READ, address: 0x8000_2008, len: Some(8) },
                    instruction(0x8000_004e, 4),
                    Reference { kind: EntryKind::READ, address: 0x8000_2010, len: Some(4) },
                    Reference { kind: EntryKind::WRITE, address: 0x8000_2010, len: Some(4) },
                ]
            },
        }
    }
}
