//! What every format must do that is written.

use super::accesses::{Seen, accesses_in};
use crate::traces::{Exporter, Kinds, Reading, Recognition, TraceExport, TraceImport};
use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink as _, lay_out};
use pm_random::Random;
use pm_registry::Registry;

/// Bytes of the lines to which accesses are cut.
const LINE: u64 = 64;
/// Accesses that are written.
const ACCESSES: usize = 500;

/// Tries every format that is written: the same accesses are the same bytes, and where the format is read as well, what was
/// written is read as what it was, as far as the format carries it; a text that tells itself does.
///
/// # Panics
/// If one of them does not.
pub fn exports(exports: &Registry<dyn TraceExport>, imports: &Registry<dyn TraceImport>) {
    let regions = regions();
    let accesses = made_up();
    for export in exports.iter() {
        let word = export.word();
        let carried = export.carried();
        let line = (!carried.sizes).then_some(LINE);
        let written = written(export, line, &regions, &accesses);
        assert!(!written.is_empty(), "{word}: nothing was written");
        assert!(written == self::written(export, line, &regions, &accesses), "{word}: not the same bytes again");
        assert!(export.is_text() == written.is_ascii(), "{word}: is it text?");
        // An import of the same word is of the same format.
        let Ok(import) = imports.find(word) else { continue };
        assert_eq!(export.is_text(), import.shape().is_text(), "{word}: text for one, and not for the other");
        let plain = Reading { access_size: line.map(|line| line as u32), ..Reading::plain() };
        let expected = expected(&accesses, &regions, carried.kinds, line);
        let found = accesses_in(&written, &plain.clone().of(import), imports);
        assert_eq!(found, Ok((word, expected.clone())), "{word}: what was written is read again");
        if import.recognition() != Recognition::ByName {
            assert_eq!(accesses_in(&written, &plain, imports), Ok((word, expected)), "{word}: it tells itself");
        }
    }
}

fn regions() -> Vec<Region> {
    lay_out([("a".into(), 20_000, 20, Coding::Records), ("b".into(), 5000, 1, Coding::Records)])
}

/// Accesses of all kinds and many lengths, made up.
fn made_up() -> Vec<Access> {
    let mut random = Random::new(&[0]);
    let mut below = |n: u64| random.next_u64() % n;
    let kinds = [AccessKind::Read, AccessKind::Write, AccessKind::ReadModifyWrite];
    let access = |_| Access {
        kind: kinds[below(3) as usize],
        region: below(2) as u16,
        len: below(500) as u32,
        offset: below(4500),
    };
    (0..ACCESSES).map(access).collect()
}

fn written(export: &'static dyn TraceExport, line: Option<u64>, regions: &[Region], accesses: &[Access]) -> Vec<u8> {
    let word = export.word();
    let refused = |error: anyhow::Error| -> ! { panic!("{word}: {error:#}") };
    let mut exporter = Exporter::new(export, line, regions, vec![]).unwrap_or_else(|error| refused(error));
    for &access in accesses {
        exporter.search(&[]);
        exporter.access(access);
        exporter.search_end();
    }
    exporter.finish().unwrap_or_else(|error| refused(error))
}

/// What a reader of a format that carries such kinds, and lines instead of sizes if there is a `line`, must see.
fn expected(accesses: &[Access], regions: &[Region], kinds: Kinds, line: Option<u64>) -> Vec<Seen> {
    let mut seen = vec![];
    for access in accesses {
        let address = regions[usize::from(access.region)].base + access.offset;
        let lines = match line {
            None => vec![(address, access.len)],
            Some(line) => {
                let last = address + u64::from(access.len.max(1)) - 1;
                (address / line..=last / line).map(|number| (number * line, line as u32)).collect()
            }
        };
        for (address, len) in lines {
            match (kinds, access.kind) {
                (Kinds::None, _) => seen.push((AccessKind::Read, address, len)),
                (Kinds::ReadsAndWrites, AccessKind::ReadModifyWrite) => {
                    seen.extend([AccessKind::Read, AccessKind::Write].map(|kind| (kind, address, len)));
                }
                (_, kind) => seen.push((kind, address, len)),
            }
        }
    }
    seen
}
