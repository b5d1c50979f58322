//! The peer, in a process of its own: its instructions are chosen when it is built, so it is built for this very machine,
//! and ours, which choose theirs when they run, for any.

use crate::answers::Answers;
use crate::clock::nanoseconds;
use crate::contestants::{Contestant as _, Kiddo};
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
    /// Nanoseconds that building its tree took.
    pub(crate) built: f64,
}

impl Peer {
    /// Starts it.
    pub(crate) fn start(program: &str, photons: &str, queries: &str) -> anyhow::Result<Self> {
        let mut command = Command::new(program);
        command.args(["serve", photons, queries]).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().with_context(|| program.to_owned())?;
        let questions = child.stdin.take().context("standard input")?;
        let replies = BufReader::new(child.stdout.take().context("standard output")?);
        let mut peer = Self { child, questions, replies, built: 0.0 };
        peer.built = peer.reply()?.parse()?;
        Ok(peer)
    }

    fn reply(&mut self) -> anyhow::Result<String> {
        let mut line = String::new();
        self.replies.read_line(&mut line)?;
        anyhow::ensure!(line.ends_with('\n'), "the peer's process has ended");
        Ok(line.trim().to_owned())
    }

    /// What it finds.
    pub(crate) fn answers(&mut self, k: usize) -> anyhow::Result<Answers> {
        writeln!(self.questions, "answers {k}")?;
        self.reply()?.parse()
    }

    /// Nanoseconds that all queries took.
    pub(crate) fn round(&mut self, k: usize) -> anyhow::Result<f64> {
        writeln!(self.questions, "round {k}")?;
        Ok(self.reply()?.parse()?)
    }

    /// Ends it.
    pub(crate) fn end(self) -> anyhow::Result<()> {
        let Self { mut child, questions, .. } = self;
        drop(questions);
        anyhow::ensure!(child.wait()?.success(), "the peer's process has failed");
        Ok(())
    }
}

/// What its process does.
pub(crate) fn serve(photons: &str, queries: &str) -> anyhow::Result<()> {
    let (photons, queries) = (Photons::read(photons)?, Queries::read(queries)?);
    let (kiddo, built) = nanoseconds(|| Kiddo::build(&photons))?;
    let mut kiddo = kiddo?;
    let mut out = stdout();
    let mut say = |reply: &dyn Display| writeln!(out, "{reply}");
    say(&built)?;
    for line in stdin().lines() {
        let line = line?;
        let (question, k) = line.split_once(' ').context("a question")?;
        let k = k.parse()?;
        match question {
            "answers" => say(&Answers::of(&mut kiddo, &queries, k))?,
            _ => say(&nanoseconds(|| kiddo.run(&queries, k, None))?.1)?,
        }
    }
    Ok(())
}
