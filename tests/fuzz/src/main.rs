//! The targets in a plain loop, the same inputs for the same seed: `pm-fuzz SECONDS [SEED [TARGET...]]`. Exit code 1 if there is a find.
//!
//! Each target runs in a process of its own, so that one that is killed, or overflows its stack, is a find like a panic.

mod trial;

use pm_fuzz::{TARGETS, root};
use std::env::{args, current_exe, temp_dir};
use std::fs;
use std::io::Write as _;
use std::process::{Command, ExitCode, id};

fn main() -> ExitCode {
    let arguments: Vec<String> = args().skip(1).collect();
    let number = |at: usize, usual: u64| arguments.get(at).and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (seconds, seed) = (number(0, 10), number(1, 0));
    let named = arguments.get(2..).unwrap_or_default();
    if let [name, last] = named
        && let Some(last) = last.strip_prefix("last=")
    {
        let target = TARGETS.iter().find(|target| target.name == name).expect("a target's name");
        return ExitCode::from(u8::from(trial::run(target, seconds, seed, last)));
    }
    if let Some(unknown) = named.iter().find(|name| TARGETS.iter().all(|target| target.name != **name)) {
        let names = TARGETS.map(|target| target.name).join(", ");
        let _ = writeln!(std::io::stderr(), "pm-fuzz: there is no target {unknown}; there are {names}");
        return ExitCode::from(2);
    }
    let mut found = false;
    for target in TARGETS.iter().filter(|target| named.is_empty() || named.iter().any(|name| name == target.name)) {
        // What it is given, before it is given it.
        let last = temp_dir().join(format!("pm-fuzz-{}-{}", id(), target.name));
        let child = Command::new(current_exe().expect("a program has a path"))
            .args([&seconds.to_string(), &seed.to_string(), target.name])
            .arg(format!("last={}", last.display()))
            // What one input claims is given back at once, not cleared again and again for those after it.
            .env("MALLOC_MMAP_THRESHOLD_", "2097152")
            .status();
        let code = child.expect("a process of its own").code();
        if !matches!(code, Some(0 | 1))
            && let Some(data) = trial::last(&last)
        {
            trial::keep(target.name, &data);
        }
        found |= code != Some(0);
        let _ = fs::remove_file(&last);
    }
    if found {
        let folder = root().join("tests/fuzz/regressions");
        let _ = writeln!(std::io::stderr(), "pm-fuzz: what was found is in {}", folder.display());
    }
    ExitCode::from(u8::from(found))
}
