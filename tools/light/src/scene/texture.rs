//! Textures, as far as they go here: the mean colour of an image.

mod mean;

use super::files::{Files, places, remark_if_outside};
use super::warnings::Warnings;
use mean::mean;
use std::collections::HashMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

pub(crate) use mean::Texture;

/// The mean colour of the image that a `map_Kd` statement of the library `mtl` names. Images are read once.
pub(crate) fn mean_colour(
    mtl: &Path,
    statement: &str,
    files: &dyn Files,
    known: &mut HashMap<PathBuf, Texture>,
    warnings: &mut Warnings,
) -> Texture {
    let name = file_name(statement).trim_matches('"').replace('\\', "/");
    let places = places(mtl, &name);
    if let Some(texture) = places.iter().find_map(|path| known.get(path)) {
        return texture.clone();
    }
    let mut why = None;
    let found = places.iter().find_map(|path| match files.read_named(path) {
        Ok(bytes) => Some((path.clone(), bytes)),
        Err(error) => {
            why = why.take().or((error.kind() != ErrorKind::NotFound).then_some(error));
            None
        }
    });
    let (path, texture) = match found {
        Some((path, bytes)) => {
            if path == places[0] {
                remark_if_outside(mtl, &name, warnings);
            }
            let texture = mean(&path, &bytes);
            (path, texture)
        }
        None => {
            let bare = name.rsplit('/').next().unwrap_or(&name);
            (
                places[0].clone(),
                Err(why.map_or(format!("{bare:?} cannot be read"), |why| format!("{bare:?} cannot be read: {why}"))),
            )
        }
    };
    known.insert(path, texture.clone());
    texture
}

/// What is left of a `map_Kd` statement without its options.
fn file_name(statement: &str) -> &str {
    let mut rest = statement.trim();
    while let Some(option) = rest.split_whitespace().next().filter(|word| word.starts_with('-') && rest != *word) {
        rest = rest[option.len()..].trim_start();
        // Options take one word, or up to three numbers.
        let (words, most) = match option {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (1, 2),
            _ => (1, 1),
        };
        for i in 0..most {
            let word = rest.split_whitespace().next().unwrap_or("");
            if word.len() == rest.len() || (i >= words && word.parse::<f32>().is_err()) {
                break;
            }
            rest = rest[word.len()..].trim_start();
        }
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Are options taken for options, and spaces and backslashes for parts of the name?
    #[test]
    fn options_are_no_part_of_the_name() {
        for (statement, name) in [
            ("wood.png", "wood.png"),
            ("-s 1 1 1 c:\\a b.png", "c:\\a b.png"),
            ("-s 2 wood grain.png", "wood grain.png"),
            ("-clamp on -mm 0 1 -o 0.5 0.5 x.jpg", "x.jpg"),
            ("-blendu off 1.png", "1.png"),
            ("-odd", "-odd"),
            ("-s 1 1 1 7", "7"),
        ] {
            assert_eq!(file_name(statement), name, "{statement}");
        }
    }
}
