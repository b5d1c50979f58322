//! One target, tried for a while.

use cap::Cap;
use pm_fuzz::{Mutator, Target, root, seeds};
use std::alloc::System;
use std::collections::HashSet;
use std::fs::{self, File};
use std::io::Write as _;
use std::os::unix::fs::FileExt as _;
use std::panic::{catch_unwind, set_hook, take_hook};
use std::path::Path;
use std::process::abort;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Memory is refused beyond the limit: who did not ask whether there is any is killed.
#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, MOST_MEMORY);

/// Longer than this no input of 64 KiB may take; behind ten times that, nobody waits.
const PATIENCE: Duration = Duration::from_secs(1);
/// More memory than this no input may take, in bytes: a block of the largest size and its records in every form on their way.
const MOST_MEMORY: usize = 1 << 29;
/// Finds of a target, each at another place, after which it is left.
const ENOUGH: usize = 10;

/// Was the last panic at a place where there was none before?
static IS_NEW: AtomicBool = AtomicBool::new(false);

/// Executions so far.
static EXECUTIONS: AtomicU64 = AtomicU64::new(0);

/// Tries a target and tells how it went. Is there a find?
pub(super) fn run(target: &Target, seconds: u64, seed: u64, last: &str) -> bool {
    let seeds = seeds(target.name);
    let file = File::create(last).expect("a file of ours");
    thread::spawn(watch);
    tell_each_place_once();
    let (begin, mut finds, mut slowest) = (Instant::now(), 0, Duration::ZERO);
    let mut kept = seeds.iter();
    let mut mutator = Mutator::new(seed);
    while begin.elapsed() < Duration::from_secs(seconds) && finds < ENOUGH {
        let data = kept.next().map_or_else(|| mutator.mutated(&seeds), Clone::clone);
        let length = u64::try_from(data.len()).expect("a short input");
        file.write_all_at(&[&length.to_le_bytes(), &data[..]].concat(), 0).expect("a file of ours");
        let start = Instant::now();
        let outcome = catch_unwind(|| (target.run)(&data));
        let took = start.elapsed();
        EXECUTIONS.fetch_add(1, Ordering::Relaxed);
        slowest = slowest.max(took);
        if (outcome.is_err() && IS_NEW.load(Ordering::Relaxed)) || took > PATIENCE {
            finds += 1;
            tell(&format!("{}: {:.3} s", target.name, took.as_secs_f64()));
            keep(target.name, &data);
        }
    }
    let line = format!(
        "{:<8} {} executions in {:.0} s, {finds} finds; at most {:.3} s and {} MiB",
        target.name,
        EXECUTIONS.load(Ordering::Relaxed),
        begin.elapsed().as_secs_f64(),
        slowest.as_secs_f64(),
        MEMORY.max_allocated() >> 20
    );
    let _ = writeln!(std::io::stdout(), "{line}");
    finds > 0
}

/// A panic at a place where there was one before is nothing new.
fn tell_each_place_once() {
    let (usual, known) = (take_hook(), Mutex::new(HashSet::new()));
    set_hook(Box::new(move |panic| {
        let place = panic.location().map_or_else(String::new, ToString::to_string);
        let is_new = known.lock().is_ok_and(|mut known| known.insert(place));
        if is_new {
            usual(panic);
        }
        IS_NEW.store(is_new, Ordering::Relaxed);
    }));
}

/// Ends the process if an input takes all too long.
fn watch() {
    let mut before = u64::MAX;
    loop {
        thread::sleep(PATIENCE * 10);
        let now = EXECUTIONS.load(Ordering::Relaxed);
        if now == before {
            tell("no answer");
            abort();
        }
        before = now;
    }
}

/// What a target was given last.
pub(super) fn last(file: &Path) -> Option<Vec<u8>> {
    let bytes = fs::read(file).ok()?;
    let (length, data) = bytes.split_first_chunk::<8>()?;
    Some(data.get(..usize::try_from(u64::from_le_bytes(*length)).ok()?)?.to_vec())
}

/// Writes a find to where tests look for it.
pub(super) fn keep(name: &str, data: &[u8]) {
    let sum = xxhash_rust::xxh3::xxh3_64(data);
    let file = root().join("tests/fuzz/regressions").join(format!("{name}-{sum:016x}"));
    tell(&format!("{} ({:?})", file.display(), fs::write(&file, data)));
}

fn tell(what: &str) {
    let _ = writeln!(std::io::stderr(), "{what}");
}
