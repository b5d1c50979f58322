//! A program that is told to stop takes its half-written files with it, and ends as a shell expects of that signal.

use super::output::remove_temporary_files;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::sync::mpsc;
use std::thread::Builder;

/// Watches for interrupt (exit code 130), hang-up (129) and terminate (143).
pub(super) fn watch() {
    let (ready, is_ready) = mpsc::channel();
    let watcher = move || {
        let signals = Signals::new([SIGINT, SIGHUP, SIGTERM]);
        // Whoever waits for it has not left.
        let _ = ready.send(());
        if let Some(signal) = signals.ok().and_then(|mut signals| signals.forever().next()) {
            remove_temporary_files(128 + signal);
        }
    };
    // Without a watcher the program still works; only the temporary file would stay behind.
    if Builder::new().name("signals".into()).spawn(watcher).is_ok() {
        let _ = is_ready.recv();
    }
}
