//! Do the commands on the README's first screen print what it shows?

use crate::support::Folder;

/// A command with the output that stands below it.
type Example = (String, Vec<String>);

/// The indented blocks before the first heading below the title.
fn examples() -> Vec<Example> {
    let readme = include_str!("../README.md");
    let first_screen = readme.split("\n## ").next().unwrap();
    let mut examples: Vec<Example> = vec![];
    for line in first_screen.lines() {
        match line.strip_prefix("    ") {
            Some(command) if command.starts_with("pm-") => examples.push((command.to_owned(), vec![])),
            Some(output) => examples.last_mut().expect("output follows a command").1.push(output.to_owned()),
            None => {}
        }
    }
    examples
}

#[test]
fn the_first_screen_prints_what_it_shows() {
    let folder = Folder::new();
    let examples = examples();
    assert_eq!(examples.len(), 3, "{examples:?}");
    for (command, expected) in examples {
        let outcome = folder.sh(&command).ok();
        let printed = String::from_utf8(outcome.stdout).unwrap();
        let printed: Vec<_> = printed.lines().map(str::to_owned).collect();
        assert_eq!(printed, expected, "{command}");
    }
}

#[test]
fn the_first_screen_says_what_the_streams_are() {
    // The figures in its sentences are those of its tables.
    let readme = include_str!("../README.md");
    let bytes: Vec<f64> = examples()
        .iter()
        .filter_map(|(_, output)| output.last()?.split_whitespace().rev().nth(3)?.parse().ok())
        .collect();
    let [hilbert, scanline] = bytes[..] else { panic!("{bytes:?}") };
    assert!(readme.contains(&format!("fetch {:.1} GB instead of {:.1} MB", scanline / 1e9, hilbert / 1e6)));
}
