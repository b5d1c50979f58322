//! What can be wrong with a scene, each in one line: what, where, and what to do about it.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A line of a text file, shown as `file:line`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileLine {
    /// The file as the user or an `mtllib` statement named it.
    pub file: PathBuf,
    /// The line, counted from 1.
    pub line: u32,
}

impl FileLine {
    pub(crate) fn new(file: &Path, line: u32) -> Self {
        Self { file: file.to_path_buf(), line }
    }

    pub(crate) fn error(&self, what: impl Into<String>) -> SceneError {
        SceneError::Statement { place: self.clone(), what: what.into() }
    }
}

impl fmt::Display for FileLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file.display(), self.line)
    }
}

/// Why a scene or a camera cannot be used. Every message is a single line.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A file that was asked for cannot be read.
    #[error("{}: {}", path.display(), reading(source, "check the name, or give the path of an OBJ file"))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file of another kind was given.
    #[error("{}: {format}, which is not read; convert it to OBJ (and check Ke: converters lose the strength of lamps)", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What it is.
        format: &'static str,
    },
    /// An `mtllib` statement names a file that cannot be read.
    #[error(
        "{place}: material library {name:?}: {}",
        reading(source, "put it beside the OBJ or correct the mtllib line")
    )]
    MissingMtl {
        /// The `mtllib` statement.
        place: FileLine,
        /// The name it gives.
        name: String,
        /// What the system said.
        source: io::Error,
    },
    /// A statement that cannot be obeyed.
    #[error("{place}: {what}")]
    Statement {
        /// The statement.
        place: FileLine,
        /// What is wrong with it, and what would be right.
        what: String,
    },
    /// No triangle is left to render.
    #[error(
        "{files}: no faces with an area; a scene needs polygons (`f` statements), curves and surfaces are not read"
    )]
    NoFaces {
        /// The files of the scene.
        files: String,
    },
    /// So far from the origin that single precision cannot tell its points apart.
    #[error(
        "{files}: {farthest} from the origin, with a size of {size}: too far for single precision, light would be lost; \
         move the scene to the origin before it is exported"
    )]
    TooFar {
        /// The files of the scene.
        files: String,
        /// Greatest coordinate, in scene units.
        farthest: f32,
        /// Largest extent, in scene units.
        size: f32,
    },
    /// Nothing emits light.
    #[error("{files}: nothing emits light{lost}; give a material `Ke`, or add a light by --quad-light")]
    NoLight {
        /// The files of the scene.
        files: String,
        /// What became of materials that would emit, or nothing.
        lost: String,
    },
    /// A light that cannot shine.
    #[error("light ({whence}): {what}")]
    Light {
        /// Where it was described: a file, or the command line.
        whence: String,
        /// What is wrong with it.
        what: String,
    },
    /// More of something than a scene can number.
    #[error("{files}: {what}")]
    TooMany {
        /// The files of the scene.
        files: String,
        /// What there is too much of, and the limit.
        what: String,
    },
    /// A camera that cannot see.
    #[error("camera ({whence}): {what}")]
    Camera {
        /// Where it was described: a file, or the command line.
        whence: String,
        /// What is wrong with it, and what would be right.
        what: String,
    },
}

/// The system's words and an advice; a missing file without the error number, which says nothing more.
fn reading(error: &io::Error, advice: &str) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => format!("no such file; {advice}"),
        _ => format!("{error}; {advice}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Does a message fit on one line, and name the place and the way out?
    #[test]
    fn messages_are_one_line_with_place_and_advice() {
        let gone = || io::Error::from(io::ErrorKind::NotFound);
        let read = SceneError::Read { path: "a.obj".into(), source: gone() }.to_string();
        assert_eq!(read, "a.obj: no such file; check the name, or give the path of an OBJ file");
        let mtl = SceneError::MissingMtl {
            place: FileLine::new(Path::new("a.obj"), 2),
            name: "m.mtl".into(),
            source: gone(),
        };
        assert_eq!(
            mtl.to_string(),
            "a.obj:2: material library \"m.mtl\": no such file; put it beside the OBJ or correct the mtllib line"
        );
    }
}
