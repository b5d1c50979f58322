//! How a run ended: what is said on standard error, and the exit code.

use super::{advice, error, say};
use std::process::ExitCode;

/// How a run of a program ended.
#[must_use]
pub struct Outcome {
    code: u8,
    /// Lines for standard error.
    said: Vec<String>,
    /// Help or version, which were asked for.
    help: Option<clap::Error>,
}

impl Outcome {
    /// Of the work itself.
    pub(super) fn of(done: anyhow::Result<()>) -> Self {
        let (code, said) = error::report(done);
        Self { code, said: said.into_iter().collect(), help: None }
    }

    /// What the parser of arguments has to say instead of arguments: help, version, or an error.
    pub(super) fn answered(error: clap::Error) -> Self {
        if !error.use_stderr() {
            return Self { code: 0, said: vec![], help: Some(error) };
        }
        let message = error.render().to_string();
        // The parser's tip for what it takes for an option is right for files only.
        let is_said = |line: &&str| !line.trim().is_empty() && !line.contains(" as a value, use '-- ");
        let lines = message.lines().filter(is_said);
        let mut said: Vec<String> = lines.map(|line| line.strip_prefix("error: ").unwrap_or(line).to_owned()).collect();
        said.splice(said.len().min(1)..said.len().min(1), advice::on(&error));
        Self { code: 2, said, help: None }
    }

    /// The same with a line more.
    pub(super) fn with(mut self, advice: Option<String>) -> Self {
        self.said.extend(advice);
        self
    }

    /// The person who asked has to ask otherwise.
    pub(super) fn asked_wrongly(text: String) -> Self {
        Self { code: 2, said: vec![text], help: None }
    }

    /// The exit code, as every help tells it.
    #[must_use]
    pub const fn code(&self) -> u8 {
        self.code
    }

    /// What is said of it on standard error.
    #[must_use]
    pub fn said(&self) -> String {
        self.said.join("\n")
    }

    /// The help or version that was asked for.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        self.help.as_ref().map(|help| help.render().to_string())
    }

    /// Tells whoever started the process.
    pub(super) fn tell(self) -> ExitCode {
        // In a pipe of several programs every line says which of them speaks.
        self.said.iter().for_each(say);
        if let Some(help) = self.help {
            // It goes to standard output, where a reader may leave early.
            let _ = help.print();
        }
        ExitCode::from(self.code)
    }
}
