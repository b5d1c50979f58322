//! Help, version, manual pages and completions.

use super::asked_wrongly;
use crate::support::{Folder, PROGRAMS};
use std::path::Path;

#[test]
fn short_help_fits_a_screen() {
    let folder = Folder::new();
    for (program, _) in PROGRAMS {
        let help = folder.run(&format!("{program} -h")).ok();
        let lines: Vec<&str> = help.text().lines().collect();
        assert!(lines.len() <= 45, "{program} -h has {} lines", lines.len());
        assert!(lines.iter().all(|line| line.chars().count() <= 100), "{program} -h is too wide");
        let takes = if program == "pm-sweep" { "<COMMAND>" } else { "[OPTIONS]" };
        assert!(help.text().contains(&format!("Usage: {program} {takes}")), "{}", help.text());
        assert!(help.text().contains("\nExamples:\n"), "{program} -h leads nowhere");
    }
}

#[test]
fn long_help_ends_with_examples_and_exit_codes() {
    let folder = Folder::new();
    for (program, _) in PROGRAMS {
        let help = folder.run(&format!("{program} --help")).ok();
        let (_, end) = help.text().split_once("\nExamples:\n").unwrap_or_else(|| panic!("{program}: no examples"));
        let (examples, codes) = end.split_once("\nExit codes:\n").unwrap_or_else(|| panic!("{program}: no exit codes"));
        assert!((2..=4).contains(&examples.lines().filter(|line| line.starts_with("  pm-")).count()), "{examples}");
        assert!(examples.contains(program), "{program}: {examples}");
        let numbers: Vec<&str> = codes.lines().filter_map(|line| line.split_whitespace().next()).collect();
        let refuses = if program == "pm-plan" { &["4"][..] } else { &[] };
        assert_eq!(numbers, [&["0", "1", "2", "3"][..], refuses].concat(), "{program}: {codes}");
    }
}

#[test]
fn the_examples_are_asked_rightly() {
    // Options change; the examples must not be left behind. Every part of every pipe runs alone, where there is no file
    // and no stream for it to read: then it fails, but for no reason of its arguments.
    let folder = Folder::new();
    let mut tried = 0;
    for (program, _) in PROGRAMS {
        let help = folder.run(&format!("{program} --help")).ok();
        let (_, end) = help.text().split_once("\nExamples:\n").expect("examples");
        let (examples, _) = end.split_once("\nExit codes:\n").expect("exit codes");
        // Long lines are wrapped; what does not begin with a program goes on the line before.
        let unwrapped = format!("\n{examples}").replace("\n  pm-", "|pm-").replace('\n', " ");
        for part in unwrapped.split('|').map(str::trim).filter(|part| !part.is_empty()) {
            let has_scene =
                ["pm-photons", "pm-queries", "pm-picture", "pm-plan"].iter().any(|name| part.starts_with(name));
            let mut line = format!("{part}{}", if has_scene { " nosuch.obj" } else { "" });
            if part.starts_with("pm-scene") {
                // The only one that needs nothing to read: it shall have nowhere to write.
                line = line.replace("-o ", "-o /dev/null/");
            }
            let outcome = folder.run(&line);
            assert!([1, 3].contains(&outcome.code), "`{line}`: exit {}\n{}", outcome.code, outcome.stderr);
            let _ = outcome.fails(outcome.code);
            tried += 1;
        }
    }
    assert!(tried >= 25, "only {tried} commands in all examples");
    assert!(folder.names().is_empty());
}

/// A line of examples after another in a folder that has what they read; pictures and streams are small.
#[test]
fn the_examples_do_what_they_say() {
    let folder = Folder::with_streams();
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    std::fs::create_dir(folder.path("scenes")).expect("a folder");
    for (name, of) in [
        ("cornell-diffuse.obj", "cornell.obj"),
        ("cornell.mtl", "cornell.mtl"),
        ("cornell-diffuse.camera.toml", "cornell.camera.toml"),
    ] {
        std::fs::copy(scenes.join(of), folder.path("scenes").join(name)).expect("a file");
    }
    folder.sh(include_str!("examples.sh")).ok();
    let mut run = 0;
    for (program, _) in PROGRAMS {
        let help = folder.run(&format!("{program} --help")).ok();
        let (_, end) = help.text().split_once("\nExamples:\n").expect("examples");
        let (examples, _) = end.split_once("\nExit codes:\n").expect("exit codes");
        let unwrapped = examples.replace("\n  pm-", "\0pm-").replace('\n', " ");
        for line in unwrapped.trim().split('\0') {
            // Shadows of the programs that are slow otherwise stand before them in the path.
            let outcome = folder.sh(&format!("PROGRAMS=${{PATH%%:*}}; export PROGRAMS PATH=$PWD/small:$PATH; {line}"));
            assert_eq!(outcome.code, 0, "`{line}`\n{}", outcome.stderr);
            run += 1;
        }
    }
    assert!(run >= 28, "only {run} examples");
}

#[test]
fn versions_say_what_ran() {
    let folder = Folder::new();
    for (program, _) in PROGRAMS {
        let short = folder.run(&format!("{program} -V")).ok();
        let expected = format!("{program} {} (rev ", env!("CARGO_PKG_VERSION"));
        assert!(short.text().starts_with(&expected) && short.text().ends_with(")\n"), "{}", short.text());
        let long = folder.run(&format!("{program} --version")).ok();
        let expected = format!("{}stream format version {}\n", short.text(), pm_formats::FORMAT_VERSION);
        assert_eq!(long.text(), expected);
    }
}

#[test]
fn manual_pages_and_completions_are_generated() {
    let folder = Folder::new();
    for (program, _) in PROGRAMS {
        let generate = |what: &str| folder.run(&format!("{program} --generate {what}")).ok().text().to_owned();
        let man = generate("man");
        assert!(man.contains(&format!(".TH {program} 1")) && man.contains(".SH \"EXIT CODES\""), "{man}");
        assert!(man.contains(".SH EXAMPLES\n"), "{man}");
        assert!(generate("zsh").starts_with(&format!("#compdef {program}")));
        assert!(generate("fish").contains(&format!("complete -c {program} ")));
        folder.write("completion", generate("bash"));
        assert!(generate("bash").contains("complete -F "));
        // `bash -n` reads without running.
        folder.sh("if command -v bash >/dev/null; then bash -n completion; fi").ok();
        assert!(asked_wrongly(&folder.run(&format!("{program} --generate pdf"))).contains("man, bash, zsh, fish"));
    }
}
