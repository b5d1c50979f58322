//! The programs as their users meet them: real processes, real pipes, real files.
//!
//! Each file answers one question, which is its first line.

mod cli;
mod damage;
mod files;
mod invariance;
mod light;
mod oracles;
mod orders;
mod pipes;
mod readme;
mod scenes;
mod streams;
mod support;
mod tidy;
mod view;
