//! Can what stands on the pages be pasted where it stands, from top to bottom, and does it print what is shown?

mod page;

use crate::support::{Folder, PROGRAMS};
use page::{Page, Script, root};
use pm_pictures::{PictureFormat, Preview};
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::symlink;

/// No page is longer, in lines; and the first one.
const MOST_LINES: usize = 200;
const MOST_LINES_OF_THE_FIRST: usize = 150;

/// Commands that are not run here: the page, how they begin, and why.
const NOT_RUN: &[(&str, &str, &str)] = &[
    ("README.md", "make ", "make builds, and runs for minutes"),
    ("README.md", "pm-picture --size 256x256", "has a test of its own"),
    ("formats/EXCHANGE.md", "valgrind ", "needs valgrind"),
    ("formats/EXCHANGE.md", "python3 -m venv", "installs packages"),
    (
        "formats/EXCHANGE.md",
        "pm-view --export dramsim3 --line 64 hilbert.pmt -o hilbert.txt\ndramsim3",
        "needs DRAMsim3",
    ),
    ("formats/python/README.md", "pip ", "installs packages"),
    ("scenes/README.md", "python3 ", "writes into the repository"),
    ("scenes/PICTURES.md", "pm-photons -n 1000000", "takes minutes; the same pipes are run small by pm-picture"),
    ("scripts/ACCURACY.md", "make ", "runs for an hour"),
    ("scripts/NEED.md", "make ", "runs for an hour"),
    ("scripts/PAPER.md", "make ", "runs for an hour"),
    ("scripts/README.md", "make ", "runs for minutes"),
    ("scripts/README.md", "salloc ", "needs a cluster"),
    ("tests/data/", "", "needs other simulators"),
    ("tools/card/", "", "needs a card"),
    ("tools/programs/options/", "", "made of the helps, whose examples `cli/help.rs` runs"),
];

/// What a page supposes its reader to have, made by these commands before its first.
const HAD: &[(&str, &str)] = &[(
    "formats/EXCHANGE.md",
    "zstd -qdc $REPOSITORY/tests/data/sum.lackey.zst > lackey.log || exit 1
     pm-photons -n 1000 -o some.pmp; pm-queries --size 16x12 --gathers 2 | pm-gather some.pmp -o hilbert.pmt
     pm-view --export raw64 hilbert.pmt -o addresses.bin; zstd -q addresses.bin -o addresses.bin.zst
     pm-view --export csv hilbert.pmt -o addresses.csv
     printf 'x,y,z,power_r,power_g,power_b,from_x,from_y,from_z,n_x,n_y,n_z\\n0.213,0,1.471,52.1,38.6,12.4,0.1,0.99,-0.05,0,1,0\\n' > photons.csv
     (head -c 16 /dev/zero; printf '\\000\\000\\200\\077'; head -c 8 /dev/zero) > points.raw",
)];

fn pages_of(folder: &str) -> Vec<Page> {
    let below = |page: &Page| match folder {
        "" => !page.path.contains('/'),
        folder => page.path.starts_with(folder),
    };
    Page::all().into_iter().filter(below).collect()
}

fn reason_not_to_run(page: &Page, script: &Script) -> Option<usize> {
    let fits = |&(path, begins, _): &(&str, &str, &str)| {
        (page.path == path || path.ends_with('/') && page.path.starts_with(path)) && script.commands.starts_with(begins)
    };
    NOT_RUN.iter().position(fits)
}

/// A folder in which the repository's own files are found by the names that pages have for them.
fn folder_of(page: &Page) -> Folder {
    let folder = Folder::new();
    for name in ["scenes", "scripts", "formats"] {
        symlink(root().join(name), folder.path(name)).expect("a link");
    }
    if let Some((_, commands)) = HAD.iter().find(|(path, _)| *path == page.path) {
        let repository = root().display().to_string();
        let outcome = folder.sh(&commands.replace("$REPOSITORY", &repository));
        assert_eq!(outcome.code, 0, "{}: {}", page.path, outcome.stderr);
    }
    folder
}

/// Runs the commands of a page in one folder, from top to bottom.
fn run(page: &Page) {
    let mut folder = None;
    for script in page.scripts() {
        if reason_not_to_run(page, &script).is_some() {
            continue;
        }
        let folder = folder.get_or_insert_with(|| folder_of(page));
        let outcome = folder.sh(&format!("set -e\n{}", script.commands));
        assert_eq!(outcome.code, 0, "{}:\n{}{}", page.path, script.commands, outcome.stderr);
        if let Some(expected) = script.printed {
            // Lines of a page have no blanks at their ends.
            let lines =
                |text: &str| text.trim_matches('\n').lines().map(|line| line.trim_end().to_owned()).collect::<Vec<_>>();
            assert_eq!(lines(outcome.text()), lines(&expected), "{}:\n{}", page.path, script.commands);
        }
    }
}

#[test]
fn the_first_page_can_be_pasted() {
    pages_of("").iter().for_each(run);
}

#[test]
fn pages_on_formats_can_be_pasted() {
    pages_of("formats/").iter().for_each(run);
}

#[test]
fn pages_on_scenes_and_scripts_can_be_pasted() {
    pages_of("scenes/").iter().chain(&pages_of("scripts/")).for_each(run);
}

#[test]
fn pages_on_tools_can_be_pasted() {
    pages_of("tools/").iter().for_each(run);
}

#[test]
fn no_page_is_forgotten() {
    let run: usize =
        ["", "formats/", "scenes/", "scripts/", "tools/"].map(|folder| pages_of(folder).len()).iter().sum();
    let others = pages_of("tests/").len() + pages_of("findings/").len();
    assert_eq!(run + others, Page::all().len());
    // Nothing is excused that does not stand there.
    let mut excused = BTreeSet::new();
    for page in Page::all() {
        excused.extend(page.scripts().iter().filter_map(|script| reason_not_to_run(&page, script)));
    }
    let idle: Vec<_> = (0..NOT_RUN.len()).filter(|at| !excused.contains(at)).map(|at| NOT_RUN[at]).collect();
    assert!(idle.is_empty(), "{idle:?}");
}

#[test]
fn pages_are_short() {
    for page in Page::all() {
        let lines = page.text.lines().count();
        let most = if page.path == "README.md" { MOST_LINES_OF_THE_FIRST } else { MOST_LINES };
        assert!(lines <= most, "{} has {lines} lines; the most is {most}", page.path);
    }
}

#[test]
fn links_lead_somewhere() {
    let mut found = 0;
    for page in Page::all() {
        let folder = root().join(&page.path).parent().expect("a folder").to_owned();
        for link in page.text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = link.split('#').next().unwrap_or_default();
            if !file.is_empty() && !file.contains("://") {
                assert!(folder.join(file).exists(), "{}: {link} leads nowhere", page.path);
                found += 1;
            }
        }
    }
    assert!(found > 50, "only {found} links");
}

#[test]
fn targets_of_make_are_there() {
    let mut makefiles = fs::read_to_string(root().join("Makefile")).expect("the Makefile");
    for entry in fs::read_dir(root().join("scripts")).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|ending| ending == "mk") {
            makefiles.push_str(&fs::read_to_string(path).expect("a text"));
        }
    }
    let targets: BTreeSet<&str> = makefiles
        .lines()
        .filter(|line| !line.starts_with(['\t', '#', ' ']))
        .filter_map(|line| line.split_once(':'))
        .flat_map(|(targets, _)| targets.split_whitespace())
        .collect();
    let is_word = |word: &str| word.chars().all(|letter| letter.is_ascii_lowercase() || letter == '-');
    let mut found = 0;
    for page in Page::all().iter().filter(|page| !page.path.starts_with("tools/card/")) {
        let scripts = page.scripts();
        let lines =
            scripts.iter().flat_map(|script| script.commands.lines()).filter_map(|line| line.strip_prefix("make "));
        let quoted = page.text.split('`').skip(1).step_by(2).filter_map(|text| text.strip_prefix("make "));
        for line in lines.chain(quoted) {
            let line = line.split(['#', '|', ';']).next().unwrap_or_default();
            for target in line.split_whitespace().filter(|word| !word.starts_with('-') && is_word(word)) {
                assert!(targets.contains(target), "{}: make {target}", page.path);
                found += 1;
            }
        }
    }
    assert!(found > 20, "only {found} targets");
}

#[test]
fn every_program_stands_on_the_first_page() {
    let first = &pages_of("")[..];
    let readme = &first.iter().find(|page| page.path == "README.md").expect("the first page").text;
    for (program, _) in PROGRAMS {
        assert!(readme.contains(&format!("\n| `{program}` |")), "README.md does not say what {program} does");
    }
}

#[test]
fn the_picture_is_made_by_the_command_below_it() {
    let readme = fs::read_to_string(root().join("README.md")).expect("the first page");
    let (_, below) = readme.split_once("](scenes/cornell.png)").expect("the picture");
    let command = below.trim_start().lines().next().expect("a command");
    assert!(command.ends_with("--image cornell.png"), "{command}");
    let folder = Folder::new();
    folder.sh(&format!("{command} -q")).ok();
    let shown = fs::read(root().join("scenes/cornell.png")).expect("the picture");
    let [made, shown] = [folder.read("cornell.png"), shown]
        .map(|png| Preview::decode(PictureFormat::Png, &png, 0.0).expect("a picture"));
    assert_eq!(made.size, shown.size);
    // The last bits of estimates may change, and a level of the preview with them.
    let differ = |(a, b): &(&[u8; 3], &[u8; 3])| (0..3).any(|channel| a[channel].abs_diff(b[channel]) > 1);
    let differing = made.pixels.iter().zip(&shown.pixels).filter(differ).count();
    let few = made.pixels.len() / 100;
    assert!(differing <= few, "scenes/cornell.png is not what `{command}` makes: {differing} pixels differ");
}

#[test]
fn the_first_screen_says_what_the_streams_are() {
    // The figures in its sentences are those of its tables.
    let page = pages_of("").into_iter().find(|page| page.path == "README.md").expect("the first page");
    let figure =
        |script: &Script| script.printed.as_ref()?.lines().last()?.split_whitespace().rev().nth(3)?.parse().ok();
    let bytes: Vec<f64> = page.scripts().iter().filter_map(figure).collect();
    let [scanline, hilbert] = bytes[..] else { panic!("{bytes:?}") };
    assert!(page.text.contains(&format!("fetch {:.1} MB instead of {:.1} GB", hilbert / 1e6, scanline / 1e9)));
}
