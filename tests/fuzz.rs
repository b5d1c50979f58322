//! Do readers answer what nobody would write: all that was ever found, and a little of what `make fuzz` tries for long?

#[allow(unreachable_pub, unused_imports, reason = "a crate of its own, taken here as a module")]
#[path = "fuzz/src/lib.rs"]
mod readers;

use pm_formats::BlockReader;
use readers::{Mutator, TARGETS, mended, regressions, seeds, unpacked};
use std::fs;

/// Changed inputs of each target.
const CHANGED: usize = 1000;

#[test]
fn what_was_found_is_answered() {
    for target in &TARGETS {
        for (name, data) in regressions(target.name) {
            // A panic says where; this says in which file.
            let outcome = std::panic::catch_unwind(|| (target.run)(&data));
            assert!(outcome.is_ok(), "tests/fuzz/regressions/{name}");
        }
    }
}

#[test]
fn every_regression_is_of_a_target() {
    let folder = readers::root().join("tests/fuzz/regressions");
    let files = fs::read_dir(folder).expect("a folder").count();
    let of_targets: usize = TARGETS.iter().map(|target| regressions(target.name).len()).sum();
    assert_eq!(files, of_targets, "left: files, right: those that a test reads");
}

#[test]
fn changed_inputs_are_answered() {
    for target in &TARGETS {
        let (seeds, mut mutator) = (seeds(target.name), Mutator::new(1));
        seeds.iter().for_each(|data| (target.run)(data));
        (0..CHANGED).for_each(|_| (target.run)(&mutator.mutated(&seeds)));
    }
}

/// Whole, to the last checksum.
fn whole(stream: &[u8]) -> bool {
    let Ok(mut blocks) = BlockReader::new(stream) else { return false };
    loop {
        match blocks.next_block() {
            Ok(None) => return true,
            Ok(Some(_)) => {}
            Err(_) => return false,
        }
    }
}

/// Without one, nothing would try the reader of an archive's walks on small inputs.
#[test]
fn a_small_input_has_coded_walks() {
    let coded = |stream: &Vec<u8>| {
        let at = 24 + u32::from_le_bytes(stream[12..16].try_into().expect("four bytes")) as usize;
        stream.len() < 4096 && stream.get(at + 6) == Some(&2)
    };
    assert!(seeds("streams").iter().any(coded));
}

#[test]
fn what_is_mended_passes_all_checksums() {
    for stream in seeds("streams").into_iter().filter(|stream| whole(stream)) {
        assert!(whole(&unpacked(&stream)));
        if stream[8] == 2 {
            assert_eq!(mended(&stream), stream, "what is whole is left as it is");
        }
        for at in [20, 24] {
            let mut changed = unpacked(&stream);
            changed[at] ^= 1;
            assert!(!whole(&changed));
            assert!(BlockReader::new(&changed[..]).is_err() || whole(&mended(&changed)), "byte {at}");
        }
    }
}
