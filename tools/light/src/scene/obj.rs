//! The pass over an OBJ file before tobj reads it, and the reading: errors get a line, traps are disarmed.

use std::collections::HashMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::error::{FileLine, SceneError};
use super::files::Files;
use super::foreign;
use super::libraries;
use super::mtl::{self, CleanMtl, NAMELESS};
use super::statements::{Statement, number, statements};
use super::warnings::Warnings;

/// Squares of larger coordinates, and so distances, overflow single precision.
const FARTHEST: f32 = 1e18;

/// An OBJ file as tobj read it.
#[derive(Debug)]
pub(crate) struct ParsedObj {
    /// Meshes in the order of the file; in each, either every vertex has a normal or none has.
    pub(crate) models: Vec<tobj::Model>,
    /// The line of every face, in the order of the models.
    pub(crate) face_lines: Vec<u32>,
    /// Every material of every library.
    pub(crate) materials: Vec<tobj::Material>,
    /// Where each material is defined.
    pub(crate) places: HashMap<String, FileLine>,
    /// Statements that look as if they made a light, and are not read.
    pub(crate) passed_over: Vec<String>,
}

/// Reads one OBJ file and the material libraries it names.
///
/// # Errors
///
/// Whatever [`SceneError`] says of reading and of statements.
pub(crate) fn parse(file: &Path, files: &dyn Files, warnings: &mut Warnings) -> Result<ParsedObj, SceneError> {
    let bytes = files.read(file).map_err(|source| SceneError::Read { path: file.to_path_buf(), source })?;
    if let Some(format) = foreign::format(file, &bytes) {
        return Err(SceneError::Foreign { path: file.to_path_buf(), format });
    }
    let statements = statements(file, &bytes)?;
    let mut cleaner =
        Cleaner { file, warnings, text: String::new(), positions: 0, normals: Vec::new(), face_lines: vec![] };
    let libraries = cleaner.libraries(&statements, files)?;
    let places: HashMap<_, _> = libraries.iter().flat_map(|library| library.places.clone()).collect();
    let passed_over = libraries.iter().flat_map(|library| library.passed_over.clone()).collect();
    let mut smooth = false;
    for statement in &statements {
        cleaner.statement(statement, &places, &mut smooth)?;
    }
    let Cleaner { text, face_lines, .. } = cleaner;

    let options = tobj::LoadOptions { single_index: true, ..Default::default() };
    let library = |name: &Path| {
        let index: Option<usize> = name.to_str().and_then(|name| name.parse().ok());
        let clean = index.and_then(|i| libraries.get(i)).ok_or(tobj::LoadError::OpenFileFailed)?;
        tobj::load_mtl_buf(&mut clean.text.as_bytes())
    };
    // The pass above leaves tobj nothing to complain of; if it does all the same, say so without a line.
    let refused = |error: tobj::LoadError| FileLine::new(file, 1).error(format!("somewhere in this file: {error}"));
    let (models, materials) = tobj::load_obj_buf(&mut text.as_bytes(), &options, library).map_err(refused)?;
    Ok(ParsedObj { models, face_lines, materials: materials.map_err(refused)?, places, passed_over })
}

struct Cleaner<'a> {
    file: &'a Path,
    warnings: &'a mut Warnings,
    text: String,
    positions: usize,
    /// For each `vn`, whether it has a direction.
    normals: Vec<bool>,
    face_lines: Vec<u32>,
}

impl Cleaner<'_> {
    /// Reads the libraries of all `mtllib` statements, each once, and names them to tobj by their number.
    /// They go first, so that a `usemtl` above its `mtllib` works.
    fn libraries(&mut self, statements: &[Statement<'_>], files: &dyn Files) -> Result<Vec<CleanMtl>, SceneError> {
        let mut seen: Vec<PathBuf> = Vec::new();
        let mut out = Vec::new();
        for statement in statements.iter().filter(|s| s.keyword() == "mtllib") {
            for (path, bytes) in libraries::named(self.file, statement, files, self.warnings)? {
                if seen.contains(&path) {
                    continue;
                }
                self.line("mtllib", &out.len().to_string());
                out.push(mtl::clean(&path, &bytes, self.warnings)?);
                seen.push(path);
            }
        }
        Ok(out)
    }

    fn statement(
        &mut self,
        statement: &Statement<'_>,
        materials: &HashMap<String, FileLine>,
        smooth: &mut bool,
    ) -> Result<(), SceneError> {
        let place = FileLine::new(self.file, statement.line);
        let keyword = statement.keyword();
        match keyword {
            "v" => self.position(statement, &place)?,
            "vn" => self.normal(statement, &place)?,
            "f" | "fo" => self.face(statement, &place, smooth)?,
            "usemtl" => {
                let name = if statement.rest().is_empty() { NAMELESS } else { statement.rest() };
                if !materials.contains_key(name) {
                    self.warnings.once(&format!("usemtl {name}"), || {
                        format!("{place}: material {name:?} is in no library; grey 0.5 takes its place")
                    });
                }
                self.line("usemtl", name);
            }
            "mtllib" | "vt" | "o" | "g" | "s" => {} // libraries are read already; the rest changes no light
            "l" | "p" => {
                self.warnings.once("obj l p", || format!("{place}: points and lines have no area and are ignored"));
            }
            _ => self.warnings.once(&format!("obj {keyword}"), || format!("{place}: {keyword} is ignored")),
        }
        Ok(())
    }

    fn position(&mut self, statement: &Statement<'_>, place: &FileLine) -> Result<(), SceneError> {
        let numbers = statement.numbers().map_err(|what| place.error(format!("v: {what}")))?;
        let [x, y, z] = match numbers[..] {
            [x, y, z] => [x, y, z],
            // Weights are of curves and surfaces: of all readers one divides by them.
            [x, y, z, _] => {
                let what = "v has a fourth number, which is left out: x, y and z are taken as they are";
                self.warnings.once("obj weight", || format!("{place}: {what}"));
                [x, y, z]
            }
            [x, y, z, _, _, _, ..] => {
                self.warnings.once("obj vertex colours", || format!("{place}: colours of vertices are ignored"));
                [x, y, z]
            }
            _ => return Err(place.error(format!("v with {} numbers; it takes x y z", numbers.len()))),
        };
        if ![x, y, z].iter().all(|c| c.abs() <= FARTHEST) {
            return Err(place.error("a vertex farther than 1e18 from the origin; scale the scene down"));
        }
        self.positions += 1;
        self.line("v", &format!("{x} {y} {z}"));
        Ok(())
    }

    /// A normal without a direction is kept in its place, so that the numbers of the others hold, but not used.
    fn normal(&mut self, statement: &Statement<'_>, place: &FileLine) -> Result<(), SceneError> {
        let words: Vec<&str> = statement.words().collect();
        if words.len() < 3 {
            return Err(place.error(format!("vn with {} numbers; it takes x y z", words.len())));
        }
        let parsed: Result<Vec<f32>, _> = words[..3].iter().map(|word| word.parse::<f32>()).collect();
        let xyz = parsed.map_err(|_| place.error(format!("vn: {:?} are not three numbers", words[..3].join(" "))))?;
        let length_squared: f64 = xyz.iter().map(|&c| f64::from(c) * f64::from(c)).sum();
        let usable = length_squared > 0.0 && length_squared.is_finite();
        if usable {
            self.line("vn", &format!("{} {} {}", xyz[0], xyz[1], xyz[2]));
        } else {
            let what = "a normal without a direction; its faces are shaded flat";
            self.warnings.once("obj vn", || format!("{place}: {what}"));
            self.line("vn", "0 0 0");
        }
        self.normals.push(usable);
        Ok(())
    }

    fn face(&mut self, statement: &Statement<'_>, place: &FileLine, smooth: &mut bool) -> Result<(), SceneError> {
        let words = statement.words();
        let corners: Vec<Corner> = words.map(|word| self.corner(word, place)).collect::<Result<_, _>>()?;
        if corners.len() < 3 {
            self.warnings.once("obj small face", || {
                format!("{place}: a face of {} corners has no area and is ignored", corners.len())
            });
            return Ok(());
        }
        let normals: Option<Vec<usize>> = corners.iter().map(|c| c.normal.filter(|&n| self.normals[n - 1])).collect();
        // tobj numbers a mesh's normals as it meets them: a mesh with some missing would get them mixed up.
        if normals.is_some() != *smooth {
            *smooth = normals.is_some();
            self.line("o", if *smooth { "smooth" } else { "flat" });
        }
        let mut line = String::new();
        for (i, corner) in corners.iter().enumerate() {
            match &normals {
                Some(normals) => write!(line, " {}//{}", corner.position, normals[i]),
                None => write!(line, " {}", corner.position),
            }
            .expect("writing to a string");
        }
        self.line("f", &line);
        self.face_lines.push(statement.line);
        Ok(())
    }

    /// One corner, `v`, `v/vt`, `v//vn` or `v/vt/vn`, with relative numbers made absolute.
    fn corner(&mut self, word: &str, place: &FileLine) -> Result<Corner, SceneError> {
        let mut parts = word.split('/');
        let position = parts.next().unwrap_or("");
        parts.next(); // texture coordinates: no textures here
        let normal = parts.next().filter(|part| !part.is_empty());
        if parts.next().is_some() {
            return Err(place.error(format!("f: {word:?} has more than three indices; it takes v/vt/vn")));
        }
        let normal = match normal.map(|word| index(word, place)).transpose()? {
            None => None,
            Some(index) => {
                let count = self.normals.len();
                let defined = absolute(index, count);
                if defined.is_none() {
                    let wrong = undefined("normal", index, count, place);
                    self.warnings.tolerate("obj normal", wrong, "its face is shaded flat")?;
                }
                defined
            }
        };
        let position = index(position, place)?;
        let defined = absolute(position, self.positions);
        Ok(Corner { position: defined.ok_or_else(|| undefined("vertex", position, self.positions, place))?, normal })
    }

    fn line(&mut self, keyword: &str, rest: &str) {
        writeln!(self.text, "{keyword} {rest}").expect("writing to a string");
    }
}

struct Corner {
    position: usize,
    normal: Option<usize>,
}

/// An index as it is written.
fn index(word: &str, place: &FileLine) -> Result<i64, SceneError> {
    word.parse().map_err(|_| match number(word) {
        Ok(_) => place.error(format!("f: index {word:?} is not a whole number")),
        Err(_) => place.error(format!("f: {word:?} is not an index; it takes v, v/vt, v//vn or v/vt/vn")),
    })
}

/// An index counted from 1 of `count` things so far, if there is such a one; negative ones count back from the last.
fn absolute(index: i64, count: usize) -> Option<usize> {
    let count = count as i64;
    let absolute = if index < 0 { index.checked_add(count)? + 1 } else { index };
    (1..=count).contains(&absolute).then_some(absolute as usize)
}

fn undefined(what: &str, index: i64, count: usize, place: &FileLine) -> SceneError {
    place.error(format!("f: {what} {index} does not exist; {count} are defined above this line, counted from 1"))
}
