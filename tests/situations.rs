//! Is what other programs read differently, or not at all, read as `scenes/README.md` says?

use crate::support::{Folder, same_text};
use std::fs;
use std::path::Path;

/// Each OBJ file of `scenes/situations` has beside it what the program says of it: remarks, and the table of materials.
#[test]
fn situations_that_programs_differ_on_are_read_as_written_down() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/scenes/situations");
    let folder = Folder::new();
    let mut names: Vec<String> = vec![];
    for entry in fs::read_dir(&corpus).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        names.extend(name.strip_suffix(".obj").map(str::to_owned));
        folder.write(&name, fs::read(&path).expect("a file"));
    }
    names.sort();
    assert_eq!(names.len(), 16);
    for name in names {
        let said = folder.run(&format!("pm-photons {name}.obj -n 0 -v -o x.pmp"));
        assert_eq!(said.code, 0, "{name}: {}", said.stderr);
        let expected = fs::read_to_string(corpus.join(format!("{name}.txt"))).expect("what is said");
        same_text(&name, &expected, &said.stderr);
    }
}
