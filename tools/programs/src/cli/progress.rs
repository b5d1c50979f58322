//! Progress on standard error, for a person who watches.

use super::output::is_pipe;
use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fs::File;
use std::io::{self, IsTerminal as _};
use std::os::fd::AsFd as _;
use std::time::Duration;

/// A progress bar that draws only where someone sees it: standard error is a terminal, and standard output is not a
/// pipe. So one program of a pipe draws, the last, and its progress is the pipe's.
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar up to `total` of the things named by `unit`, or a counter where the total is not known.
    #[must_use]
    pub fn new(total: Option<u64>, unit: &str, quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(total, target(quiet));
        let template = match total {
            Some(_) => format!("{{wide_bar}} {{human_pos}}/{{human_len}} {unit}, {{rate}}/s, {{eta}} left"),
            None => format!("{{spinner}} {{human_pos}} {unit}, {{rate}}/s"),
        };
        let rate = |state: &ProgressState, text: &mut dyn std::fmt::Write| {
            let _ = write!(text, "{}", HumanCount(state.per_sec() as u64));
        };
        bar.set_style(ProgressStyle::with_template(&template).expect("a valid template").with_key("rate", rate));
        Self(bar)
    }

    /// What is done, and for how long, where nobody knows how much is left.
    #[must_use]
    pub fn spinner(quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(None, target(quiet));
        bar.set_style(ProgressStyle::with_template("{spinner} {elapsed} {msg}").expect("a valid template"));
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(200));
        }
        Self(bar)
    }

    /// This is done next.
    pub fn tell(&self, doing: &str) {
        self.0.set_message(doing.to_owned());
    }

    /// `n` more are done.
    pub fn add(&self, n: u64) {
        self.0.inc(n);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// Where someone sees it.
fn target(quiet: bool) -> ProgressDrawTarget {
    let seen = !quiet && io::stderr().is_terminal() && !stdout_is_pipe();
    if seen { ProgressDrawTarget::stderr_with_hz(10) } else { ProgressDrawTarget::hidden() }
}

fn stdout_is_pipe() -> bool {
    let file = io::stdout().as_fd().try_clone_to_owned().map(File::from);
    file.is_ok_and(|file| is_pipe(&file))
}
