//! Lines of addresses, with or without sizes and kinds, between commas, semicolons or tabs.
//!
//! A first line with a column `address` names the columns (`address`, `size`, `kind`; others are passed over). Without
//! one they are these three, or those given. Numbers are decimal, or hexadecimal with `0x`.

use super::numbers::{number, quoted, size};
use super::{Kind, MODIFY, Parsed, READ, Reference, WRITE};
use crate::fault::bad_question;

/// Where the columns are.
#[derive(Clone, Debug)]
pub(super) struct Csv {
    columns: Option<Columns>,
}

#[derive(Clone, Copy, Debug)]
struct Columns {
    address: usize,
    size: Option<usize>,
    kind: Option<usize>,
}

impl Columns {
    fn named(names: &[String]) -> Option<Self> {
        let find = |name: &str| names.iter().position(|known| known == name);
        Some(Self { address: find("address")?, size: find("size"), kind: find("kind") })
    }

    const PLAIN: Self = Self { address: 0, size: Some(1), kind: Some(2) };
}

impl Csv {
    /// With the columns given, or as the first line says.
    ///
    /// # Errors
    /// Usage, if the columns given make no sense.
    pub(super) fn new(columns: Option<&[String]>) -> anyhow::Result<Self> {
        let Some(names) = columns else { return Ok(Self { columns: None }) };
        let known = |name: &String| ["address", "size", "kind", "_"].contains(&name.as_str());
        let doubled = |name: &str| names.iter().filter(|other| *other == name).count() > 1;
        if !names.iter().all(known) || ["address", "size", "kind"].into_iter().any(doubled) {
            return Err(bad_question(
                "--columns: columns are address, size and kind, once each, and _ for one to skip",
            ));
        }
        match Columns::named(names) {
            Some(columns) => Ok(Self { columns: Some(columns) }),
            None => Err(bad_question("--columns: one of them must be address")),
        }
    }

    pub(super) fn parse(&mut self, line: &[u8]) -> Parsed {
        if line.trim_ascii().is_empty() {
            return Ok(None);
        }
        let clean = |field: &'_ [u8]| -> Vec<u8> {
            let field = field.trim_ascii();
            let inner = field.strip_prefix(b"\"").and_then(|field| field.strip_suffix(b"\""));
            inner.unwrap_or(field).to_vec()
        };
        let fields: Vec<Vec<u8>> = line.split(|byte| b",;\t".contains(byte)).map(clean).collect();
        let columns = match self.columns {
            Some(columns) => columns,
            None => {
                let lower = |field: &Vec<u8>| String::from_utf8_lossy(field).to_ascii_lowercase();
                let names: Vec<String> = fields.iter().map(lower).collect();
                if let Some(columns) = Columns::named(&names) {
                    self.columns = Some(columns);
                    return Ok(None);
                }
                if fields.len() > 3 {
                    return Err("more than address, size and kind; name the columns with --columns".into());
                }
                Columns::PLAIN
            }
        };
        let field = |column: usize| fields.get(column).filter(|field| !field.is_empty());
        let address = field(columns.address).ok_or_else(|| format!("{} has no address", quoted(line)))?;
        let address = number(address)?;
        let len = columns.size.and_then(field).map(|field| size(number(field)?)).transpose()?;
        let kind = columns.kind.and_then(field).map_or(Ok(READ), |field| kind(field))?;
        self.columns = Some(columns);
        Ok(Some(Reference { kind, address, len }))
    }
}

fn kind(field: &[u8]) -> Result<Kind, String> {
    match &*field.to_ascii_lowercase() {
        b"r" | b"read" | b"l" | b"ld" | b"load" => Ok(READ),
        b"w" | b"write" | b"s" | b"st" | b"store" => Ok(WRITE),
        b"m" | b"rmw" | b"modify" => Ok(MODIFY),
        b"i" | b"instruction" => Ok(Kind::Instruction),
        _ => Err(format!("kind {} is none of read, write, rmw, instruction", quoted(field))),
    }
}
