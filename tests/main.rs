//! The programs as their users meet them: real processes, real pipes, real files.
//!
//! Each file answers one question, which is its first line.

mod accuracy;
mod approximate;
mod archive;
mod chains;
mod charts;
mod circles;
mod cli;
mod columns;
mod curves;
mod damage;
mod dram;
mod estimates;
mod files;
mod foreign;
mod fuzz;
mod guide;
mod held;
mod invariance;
mod leaks;
mod light;
mod oracles;
mod orders;
mod page;
mod parts;
mod pictures;
mod pipes;
mod plan;
mod precomputed;
mod private;
mod readme;
mod recipes;
mod reverse;
mod same_scene;
mod scenes;
mod situations;
mod slopes;
mod specular;
mod streams;
mod support;
mod sweep;
mod tidy;
mod variants;
mod view;
mod windows;
