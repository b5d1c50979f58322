//! x
pub mod cache;
pub mod report;
pub mod scene;
pub mod size;
