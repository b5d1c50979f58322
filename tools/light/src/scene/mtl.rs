//! The pass over an MTL file before tobj reads it: whatever tobj would choke on is mended or named with its line.

use std::collections::HashMap;
use std::fmt::Write;
use std::path::Path;

use super::error::{FileLine, SceneError};
use super::statements::{Statement, number, statements};
use super::warnings::Warnings;

/// A material library that tobj reads without loss.
#[derive(Debug)]
pub(crate) struct CleanMtl {
    /// The text to parse.
    pub(crate) text: String,
    /// Where each material is defined.
    pub(crate) places: HashMap<String, FileLine>,
    /// Statements that look as if they made a light, and are not read: what, and where.
    pub(crate) passed_over: Vec<String>,
}

/// What a material without a name is called.
pub(crate) const NAMELESS: &str = "(unnamed)";

/// Rewrites a material library so that tobj can read it.
///
/// # Errors
///
/// [`SceneError::Statement`] for a bad number or a negative colour, and for a material without a name if that is not
/// tolerated.
pub(crate) fn clean(file: &Path, bytes: &[u8], warnings: &mut Warnings) -> Result<CleanMtl, SceneError> {
    let mut out = CleanMtl { text: String::new(), places: HashMap::new(), passed_over: vec![] };
    for statement in &statements(file, bytes)? {
        let place = FileLine::new(file, statement.line);
        let keyword = statement.keyword();
        if keyword == "newmtl" {
            let mut name = statement.rest();
            if name.is_empty() {
                name = NAMELESS;
                let wrong = place.error("newmtl without a name; give the material one");
                warnings.tolerate("mtl newmtl", wrong, &format!("it is called {NAMELESS:?}"))?;
            }
            out.line("newmtl", name);
            if out.places.insert(name.to_owned(), place.clone()).is_some() {
                warnings.say(format!("{place}: material {name:?} is defined twice; the later one counts"));
            }
            continue;
        }
        if out.places.is_empty() {
            warnings.once("mtl before newmtl", || format!("{place}: {keyword} before any newmtl is ignored"));
            continue;
        }
        if keyword == "map_Ke" || (keyword != "Ke" && keyword.eq_ignore_ascii_case("Ke")) {
            let why = if keyword == "map_Ke" { "" } else { ", which is not `Ke`" };
            out.passed_over.push(format!("`{keyword}` in {place}{why}"));
        }
        match keyword {
            "Ka" => {} // ambient light has no place in a simulation of light
            "Kd" | "Ks" | "Ke" | "Tf" => {
                if let Some([r, g, b]) = colour(statement, &place, warnings)? {
                    out.line(keyword, &format!("{r} {g} {b}"));
                }
            }
            "Ns" | "Ni" | "d" | "Tr" | "Pm" | "Pr" => {
                let value = scalar(statement, &place, warnings)?;
                out.line(keyword, &value.to_string());
            }
            "illum" => {
                let model = scalar(statement, &place, warnings)?;
                if model.fract() == 0.0 && (0.0..=10.0).contains(&model) {
                    out.line(keyword, &model.to_string());
                } else {
                    warnings.say(format!("{place}: illum {model} is not one of 0 to 10 and ignored"));
                }
            }
            "map_Kd" if !statement.rest().is_empty() => out.line(keyword, statement.rest()),
            _ if keyword.starts_with("map_") || ["bump", "disp", "norm", "refl", "decal"].contains(&keyword) => {
                warnings.once("mtl texture", || format!("{place}: {keyword}: textures other than map_Kd are ignored"));
            }
            // Sheen, clearcoat and anisotropy, which exporters write whether used or not.
            "Ps" | "Pc" | "Pcr" | "aniso" | "anisor" if statement.words().all(|word| number(word) == Ok(0.0)) => {}
            _ => warnings.once(&format!("mtl {keyword}"), || format!("{place}: {keyword} is ignored")),
        }
    }
    Ok(out)
}

impl CleanMtl {
    fn line(&mut self, keyword: &str, rest: &str) {
        writeln!(self.text, "{keyword} {rest}").expect("writing to a string");
    }
}

/// Three channels; one number stands for all three and a missing third is the first, as the MTL text has it.
/// `None` for a spectrum or CIE XYZ, which are not read.
fn colour(s: &Statement<'_>, place: &FileLine, warnings: &mut Warnings) -> Result<Option<[f32; 3]>, SceneError> {
    let keyword = s.keyword();
    if let Some(form @ ("spectral" | "xyz")) = s.words().next() {
        warnings.once(&format!("mtl {form}"), || {
            format!("{place}: {keyword} {form} is ignored; give it as red green blue")
        });
        return Ok(None);
    }
    let numbers = s.numbers().map_err(|what| place.error(format!("{keyword}: {what}")))?;
    let rgb = match numbers[..] {
        [] => return Err(place.error(format!("{keyword} without a number; give red green blue"))),
        [r] => [r; 3],
        [r, g] => [r, g, r],
        [r, g, b, ..] => [r, g, b],
    };
    if rgb.iter().any(|&x| x < 0.0) {
        return Err(place.error(format!("{keyword} is negative; give numbers from 0 up")));
    }
    Ok(Some(rgb))
}

fn scalar(s: &Statement<'_>, place: &FileLine, warnings: &mut Warnings) -> Result<f32, SceneError> {
    let keyword = s.keyword();
    let mut words = s.words().peekable();
    if words.next_if_eq(&"-halo").is_some() {
        warnings.once("mtl halo", || format!("{place}: {keyword} -halo is read as plain {keyword}"));
    }
    let word = words.next().ok_or_else(|| place.error(format!("{keyword} without a number")))?;
    number(word).map_err(|what| place.error(format!("{keyword}: {what}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cleaned(text: &str) -> (String, Vec<String>) {
        let mut warnings = Warnings::default();
        let clean = clean(Path::new("m.mtl"), text.as_bytes(), &mut warnings).unwrap();
        (clean.text, warnings.into_lines())
    }

    fn error(text: &str) -> String {
        clean(Path::new("m.mtl"), text.as_bytes(), &mut Warnings::default()).unwrap_err().to_string()
    }

    /// Are colours of one and two numbers, on which tobj panics, completed as the MTL text says?
    #[test]
    fn short_colours_are_completed() {
        let (text, warnings) = cleaned("newmtl a\nKd 0.5\nKs .1 .2 # two\nKe 1 2 3 4\n");
        assert_eq!(text, "newmtl a\nKd 0.5 0.5 0.5\nKs 0.1 0.2 0.1\nKe 1 2 3\n");
        assert!(warnings.is_empty());
    }

    /// Does a spectrum cost only its own line, not the whole library?
    #[test]
    fn spectral_colours_are_dropped_with_a_warning() {
        let (text, warnings) = cleaned("newmtl a\nKd spectral x.rfl\nKd xyz 1 1 1\nNi 1.5\n");
        assert_eq!(text, "newmtl a\nNi 1.5\n");
        assert_eq!(warnings[0], "m.mtl:2: Kd spectral is ignored; give it as red green blue");
        assert_eq!(warnings.len(), 2);
    }

    /// Is a bad number named with its line instead of losing every material?
    #[test]
    fn bad_numbers_name_their_line() {
        assert_eq!(error("newmtl a\nKd 1 one 1\n"), "m.mtl:2: Kd: \"one\" is not a number");
        assert_eq!(error("newmtl a\n\nNs\n"), "m.mtl:3: Ns without a number");
        assert_eq!(error("newmtl a\nKd 1 -1 1\n"), "m.mtl:2: Kd is negative; give numbers from 0 up");
        assert!(error("newmtl a\nKe inf\n").starts_with("m.mtl:2: Ke: \"inf\" is infinite"));
        assert!(error("newmtl a\nd nan\n").starts_with("m.mtl:2: d: \"nan\" is not a number"));
    }

    /// Is a material without a name gone on with, unless the reading is strict?
    #[test]
    fn nameless_materials_have_a_name() {
        let (text, warnings) = cleaned("newmtl\nKd 1 0 0\n");
        assert_eq!(text, "newmtl (unnamed)\nKd 1 0 0\n");
        assert_eq!(warnings, ["m.mtl:1: newmtl without a name; give the material one: it is called \"(unnamed)\""]);
        let strict = clean(Path::new("m.mtl"), b"newmtl\n", &mut Warnings::new(true)).unwrap_err().to_string();
        assert_eq!(strict, "m.mtl:1: newmtl without a name; give the material one");
    }

    /// Are unknown statements said once each, and the zeros of PBR exporters not at all?
    #[test]
    fn unknown_statements_are_said_once() {
        let (_, warnings) = cleaned("newmtl a\nPs 0\naniso 0.0\nKt 1\nKt 2\nmap_Bump x.png\nbump y\nPc 0.5\n");
        assert_eq!(
            warnings,
            [
                "m.mtl:4: Kt is ignored (and 1 more like this)",
                "m.mtl:6: map_Bump: textures other than map_Kd are ignored (and 1 more like this)",
                "m.mtl:8: Pc is ignored",
            ]
        );
    }

    /// Are the oddities of `d` and `illum` read, and statements outside a material named?
    #[test]
    fn halo_and_float_illum_and_orphans() {
        let (text, warnings) = cleaned("Kd 1\nnewmtl a\nd -halo 0.5\nillum 2.0\nillum 11\nnewmtl a\n");
        assert_eq!(text, "newmtl a\nd 0.5\nillum 2\nnewmtl a\n");
        assert_eq!(warnings.len(), 4);
        assert_eq!(warnings[3], "m.mtl:6: material \"a\" is defined twice; the later one counts");
    }
}
