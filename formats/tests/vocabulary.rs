//! Does the specification have every name that one program writes and another reads?

/// The names in a file of the vocabulary: what stands between quotes.
fn names(source: &'static str) -> Vec<&'static str> {
    let names: Vec<&str> = source.lines().filter(|line| line.starts_with("pub const ")).collect();
    assert!(names.len() > 10, "{names:?}");
    names.into_iter().map(|line| line.split('"').nth(1).expect("a name")).collect()
}

#[test]
fn every_name_is_specified() {
    let specification = include_str!("../README.md");
    for source in [include_str!("../src/vocabulary/meaning.rs"), include_str!("../src/vocabulary/measure.rs")] {
        for name in names(source) {
            assert!(specification.contains(&format!("`{name}`")), "README.md does not say what `{name}` is");
        }
    }
}
