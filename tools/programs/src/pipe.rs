//! Our programs in a pipe, as child processes.

use crate::cli::usage;
use anyhow::{Context as _, bail};
use pm_exchange::bad_input;
use std::fmt;
use std::io::Read as _;
use std::path::PathBuf;
use std::process::{Child, ChildStdout, Command, Stdio};

/// Programs, each reading what the one before it writes.
pub(crate) struct Pipe(Vec<(&'static str, Vec<String>)>);

impl Pipe {
    pub(crate) fn new(program: &'static str, arguments: impl IntoIterator<Item = String>) -> Self {
        Self(vec![]).then(program, arguments)
    }

    pub(crate) fn then(mut self, program: &'static str, arguments: impl IntoIterator<Item = String>) -> Self {
        self.0.push((program, arguments.into_iter().collect()));
        self
    }

    /// The last program has these arguments too.
    pub(crate) fn with(mut self, arguments: impl IntoIterator<Item = String>) -> Self {
        self.0.last_mut().expect("a program").1.extend(arguments);
        self
    }

    /// What the last of them prints.
    ///
    /// # Errors
    /// If one of them fails; it has said why.
    pub(crate) fn run(&self) -> anyhow::Result<Vec<u8>> {
        let folder = folder()?;
        let mut children: Vec<(&str, Child)> = vec![];
        let mut before: Option<ChildStdout> = None;
        for (program, arguments) in &self.0 {
            let mut command = Command::new(folder.join(program));
            command.args(arguments).stdin(before.take().map_or_else(Stdio::null, Stdio::from));
            let child = command.stdout(Stdio::piped()).spawn();
            let mut child = child.with_context(|| folder.join(program).display().to_string())?;
            before = child.stdout.take();
            children.push((program, child));
        }
        let mut printed = vec![];
        before.context("a pipe has programs")?.read_to_end(&mut printed)?;
        // Whoever fails first has failed for a reason of its own; those behind it, for want of a whole stream.
        let ended = children.into_iter().map(|(program, mut child)| Ok((program, child.wait()?)));
        for (program, status) in ended.collect::<std::io::Result<Vec<_>>>()? {
            let text = format!("{program} failed ({status}), and says why above");
            match status.code() {
                Some(0) => {}
                Some(2) => return Err(usage(text)),
                Some(3) => return Err(bad_input(text)),
                _ => bail!(text),
            }
        }
        Ok(printed)
    }
}

/// As it is typed in a shell.
impl fmt::Display for Pipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, (program, arguments)) in self.0.iter().enumerate() {
            write!(f, "{}{program}", if at > 0 { " | " } else { "" })?;
            for word in arguments {
                // The one thing that no quoting can hold is a zero byte, which no argument can either.
                write!(f, " {}", shlex::try_quote(word).map_err(|_| fmt::Error)?)?;
            }
        }
        Ok(())
    }
}

/// Where the programs are.
fn folder() -> anyhow::Result<PathBuf> {
    if let Some(folder) = std::env::var_os("BIN") {
        return Ok(folder.into());
    }
    let own = std::env::current_exe().context("where the programs are")?;
    Ok(own.parent().map_or_else(PathBuf::new, PathBuf::from))
}
