//! x
pub mod cache;
pub mod scene;
