//! Does every option of every program stand on its page, as the program defines it?

use crate::support::{Folder, PROGRAMS, same_text};
use std::fs;
use std::path::Path;

/// The pages of options.
fn pages() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("options")
}

#[test]
fn pages_of_options_are_those_of_the_programs() {
    let folder = Folder::new();
    for (program, _) in PROGRAMS {
        let made = folder.run(&format!("{program} --generate options")).ok();
        let kept = fs::read_to_string(pages().join(format!("{program}.md"))).unwrap_or_default();
        same_text(&format!("tools/programs/options/{program}.md: `make options` writes it anew"), made.text(), &kept);
    }
    let number = fs::read_dir(pages()).expect("the pages").count();
    assert_eq!(number, PROGRAMS.len(), "a page for each program, and no other");
}

#[test]
fn pages_have_all_options_of_the_help() {
    // Help, as clap prints it, and page are made by different code.
    let folder = Folder::new();
    let mut found = 0;
    for (program, _) in PROGRAMS {
        let page = folder.run(&format!("{program} --generate options")).ok().text().to_owned();
        let help = folder.run(&format!("{program} --help")).ok().text().to_owned();
        let (help, _) = help.split_once("\nExamples:\n").expect("examples");
        let options = help.lines().map(str::trim_start).filter(|line| line.starts_with('-') && !line.starts_with("- "));
        let names = options.flat_map(|line| line.split([' ', ',', '='])).filter(|word| word.starts_with("--"));
        for name in names.map(|name| name.trim_end_matches(['.', ':', '[', ';'])) {
            if !["--help", "--version"].contains(&name) {
                assert!(page.contains(&format!("`{name}`")), "{program}: {name} does not stand on its page");
                found += 1;
            }
        }
    }
    assert!(found > 120, "only {found} options");
}
