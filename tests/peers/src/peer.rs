//! The libraries, in a process of their own: their instructions are chosen when they are built, so they are built for this
//! very machine, and ours, which choose theirs when they run, for any.

use crate::aim::Aim;
use crate::answers::Answers;
use crate::clock::nanoseconds;
use crate::libraries::LIBRARIES;
use crate::streams::{Photons, Queries};
use anyhow::Context as _;
use std::fmt::Display;
use std::io::{BufRead as _, BufReader, Write as _, stdin, stdout};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Runs a round when it is asked for one.
pub(crate) struct Peer {
    child: Child,
    questions: ChildStdin,
    replies: BufReader<ChildStdout>,
}

impl Peer {
    /// Starts it.
    pub(crate) fn start(program: &str, photons: &str, queries: &str) -> anyhow::Result<Self> {
        let mut command = Command::new(program);
        command.args(["serve", photons, queries]).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().with_context(|| program.to_owned())?;
        let questions = child.stdin.take().context("standard input")?;
        let replies = BufReader::new(child.stdout.take().context("standard output")?);
        Ok(Self { child, questions, replies })
    }

    fn reply(&mut self) -> anyhow::Result<String> {
        let mut line = String::new();
        self.replies.read_line(&mut line)?;
        anyhow::ensure!(line.ends_with('\n'), "the peer's process has ended");
        Ok(line.trim().to_owned())
    }

    /// What a library finds.
    pub(crate) fn answers(&mut self, library: usize, aim: Aim) -> anyhow::Result<Answers> {
        writeln!(self.questions, "answers {library} {aim}")?;
        self.reply()?.parse()
    }

    /// Nanoseconds that all queries took a library.
    pub(crate) fn round(&mut self, library: usize, aim: Aim) -> anyhow::Result<f64> {
        writeln!(self.questions, "round {library} {aim}")?;
        Ok(self.reply()?.parse()?)
    }

    /// Nanoseconds that a library took to build its tree once more.
    pub(crate) fn building(&mut self, library: usize) -> anyhow::Result<f64> {
        writeln!(self.questions, "build {library} 1")?;
        Ok(self.reply()?.parse()?)
    }

    /// Ends it.
    pub(crate) fn end(&mut self) -> anyhow::Result<()> {
        let Self { child, questions, .. } = self;
        writeln!(questions, "end 0 1")?;
        anyhow::ensure!(child.wait()?.success(), "the peer's process has failed");
        Ok(())
    }
}

/// What its process does.
pub(crate) fn serve(photons: &str, queries: &str) -> anyhow::Result<()> {
    let (photons, queries) = (Photons::read(photons)?, Queries::read(queries)?);
    let mut contestants = LIBRARIES.iter().map(|library| (library.build)(&photons)).collect::<Result<Vec<_>, _>>()?;
    let mut out = stdout();
    let mut say = |reply: &dyn Display| writeln!(out, "{reply}");
    for line in stdin().lines() {
        let line = line?;
        let words: Vec<&str> = line.split(' ').collect();
        let &[question, library, aim] = &words[..] else { anyhow::bail!("a question") };
        let (library, aim): (usize, Aim) = (library.parse()?, aim.parse()?);
        let contestant = &mut contestants[library];
        match question {
            "answers" => say(&Answers::of(&mut **contestant, &queries, aim))?,
            "build" => {
                let (built, took) = nanoseconds(|| (LIBRARIES[library].build)(&photons))?;
                drop(built?);
                say(&took)?;
            }
            "end" => break,
            _ => say(&nanoseconds(|| contestant.run(&queries, aim, None))?.1)?,
        }
    }
    Ok(())
}
