//! Folders: of two makes at once, with blanks in their names, and with any awk or none.

use super::{TABLE, command, make, said, workshop};
use crate::support::wait_until;
use std::fs;
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};

#[test]
fn of_two_makes_at_once_the_second_says_who_has_the_folder() {
    let folder = workshop();
    let words = "-j2 run SIZE=16x16 GATHERS=4 PHOTONS=500";
    let start =
        || command(&folder, words, &[]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("make runs");
    let both = [start(), start()].map(|child| child.wait_with_output().expect("make ends"));
    let is_refused = |output: &Output| said(output).contains("`make run` holds out/, process ");
    for output in &both {
        assert!(output.status.success() != is_refused(output), "{}", said(output));
    }
    assert!(both.iter().any(|output| output.status.success()));
    // What is there is whole.
    let again = make(&folder, words);
    assert!(again.status.success() && !said(&again).contains("pm-gather"), "{}", said(&again));
}

#[test]
fn a_folder_is_held_as_long_as_make_runs_and_reading_is_free() {
    let folder = workshop();
    let table = "point,command\na,until [ -e go ]; do sleep 0.1; done && printf \"x\\n1\\n\"\n";
    folder.write("my.csv", table);
    let words = "sweep SWEEP=my.csv";
    let first = command(&folder, words, &[]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("make runs");
    wait_until("the point runs", || folder.path("out/my/a.csv.part").exists());
    let second = make(&folder, words);
    let holder = format!("`make sweep` holds out/, process {} on ", first.id());
    assert!(!second.status.success() && said(&second).contains(&holder), "{}", said(&second));
    assert!(!make(&folder, "clean").status.success());
    for free in ["help", "-n sweep SWEEP=my.csv"] {
        assert!(make(&folder, free).status.success(), "{free}");
    }
    folder.write("go", "");
    let first = first.wait_with_output().expect("make ends");
    assert!(first.status.success(), "{}", said(&first));
    assert!(make(&folder, words).status.success() && make(&folder, "clean").status.success());
    assert!(!folder.path("out").exists());
}

#[test]
fn tables_and_scenes_may_lie_in_folders_with_blanks() {
    let folder = workshop();
    for name in ["my tables", "my scenes"] {
        fs::create_dir(folder.path(name)).unwrap();
    }
    for name in ["cornell.obj", "cornell.mtl", "cornell.camera.toml"] {
        fs::copy(folder.path("scenes").join(name), folder.path("my scenes").join(name)).unwrap();
    }
    let table = "point,scene,photons,queries\na,\"\"\"my scenes/cornell.obj\"\"\",-n 500,--size 8x8 --gathers 4\n";
    folder.write("my tables/mine.csv", table);
    let sweep = || {
        let mut command = command(&folder, "sweep", &[]);
        command.arg("SWEEP=my tables/mine.csv").output().expect("make runs")
    };
    let outcome = sweep();
    assert!(outcome.status.success() && said(&outcome).contains("out/mine.csv: 1 rows"), "{}", said(&outcome));
    assert!(!said(&sweep()).contains("pm-gather"));
    // A newer scene is another.
    let scene = fs::read(folder.path("my scenes/cornell.obj")).unwrap();
    fs::write(folder.path("my scenes/cornell.obj"), scene).unwrap();
    assert!(said(&sweep()).contains("pm-photons"));
    // The name of a table is that of what make makes.
    folder.write("my tables/my own.csv", TABLE);
    let mut named = command(&folder, "sweep", &[]);
    let outcome = named.arg("SWEEP=my tables/my own.csv").output().expect("make runs");
    assert!(
        said(&outcome).contains("my tables/my own.csv:1: `my own` shall name what make makes"),
        "{}",
        said(&outcome)
    );
}

/// Folders to put first on the path: of each awk that is there, and of one that is none.
fn awks(folder: &Path) -> Vec<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let find = |name: &str| std::env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.exists());
    let mut awks = vec![];
    for name in ["mawk", "gawk", "busybox", "original-awk"] {
        let Some(file) = find(name) else { continue };
        let of_awk = folder.join(format!("awk-{name}"));
        fs::create_dir(&of_awk).unwrap();
        symlink(file, of_awk.join("awk")).unwrap();
        awks.push(of_awk);
    }
    let none = folder.join("awk-none");
    fs::create_dir(&none).unwrap();
    for name in ["awk", "mawk", "gawk", "nawk"] {
        fs::write(none.join(name), "#!/bin/sh\necho there is no awk >&2\nexit 127\n").unwrap();
        fs::set_permissions(none.join(name), fs::Permissions::from_mode(0o755)).unwrap();
    }
    awks.push(none);
    awks
}

#[test]
fn any_awk_will_do_and_so_will_none() {
    let folder = workshop();
    let said_by = |awk: Option<&Path>, goals: &str| {
        let mut command = command(&folder, goals, &[]);
        let path = std::env::var("PATH").unwrap_or_default();
        let path = awk.map_or(path.clone(), |awk| format!("{}:{path}", awk.display()));
        let outcome = command.env("PATH", path).output().expect("make runs");
        assert!(outcome.status.success() && outcome.stderr.is_empty(), "{awk:?} {goals}: {}", said(&outcome));
        said(&outcome)
    };
    let awks = awks(&folder.path("."));
    for goals in ["help", "-n paper"] {
        // Rules are made the first time.
        said_by(None, goals);
        let usual = said_by(None, goals);
        assert!(usual.lines().count() > 20, "{usual}");
        for awk in &awks {
            assert_eq!(said_by(Some(awk), goals), usual, "{}", awk.display());
        }
    }
}
