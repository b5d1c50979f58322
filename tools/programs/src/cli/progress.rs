//! Progress on standard error, for a person who watches.

use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fs::File;
use std::io::{self, IsTerminal as _};
use std::os::fd::AsFd as _;
use std::os::unix::fs::FileTypeExt as _;

/// A progress bar that draws only where someone sees it: standard error is a terminal, and standard output is not a
/// pipe. So one program of a pipe draws, the last, and its progress is the pipe's.
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar up to `total` of the things named by `unit`, or a counter where the total is not known.
    #[must_use]
    pub fn new(total: Option<u64>, unit: &str, quiet: bool) -> Self {
        let seen = !quiet && io::stderr().is_terminal() && !stdout_is_pipe();
        let target = if seen { ProgressDrawTarget::stderr_with_hz(10) } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(total, target);
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

fn stdout_is_pipe() -> bool {
    let file = io::stdout().as_fd().try_clone_to_owned().map(File::from);
    file.and_then(|file| file.metadata()).is_ok_and(|metadata| metadata.file_type().is_fifo())
}
