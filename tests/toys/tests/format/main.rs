//! A format of traces is a file and a line: three toys, one that is read and written, one only read, one only written, are
//! added from outside, and are at once in every generic test, in the programs' help and errors, and in the documentation.

mod arrows;
mod beads;
mod liars;
mod shouts;

use arrows::Arrows;
use beads::Beads;
use liars::{Boasts, Forgets, Grabs};
use pm_exchange::traces::{self, Opened, Reading, TraceExport, TraceImport};
use pm_exchange::trial;
use pm_formats::trace::{Access, BlockEncoder, Coding, TraceSink, TraceWriter, lay_out};
use pm_formats::{BlockMeta, Header};
use pm_programs::{cachesim, view};
use pm_registry::Registry;
use shouts::Shouts;
use std::fs;
use std::io::BufReader;

/// The formats there are, and a line for each that is new.
fn imports() -> Registry<dyn TraceImport> {
    traces::imports().with(&Arrows).with(&Beads)
}

/// The formats there are, and a line for each that is new.
fn exports() -> Registry<dyn TraceExport> {
    traces::exports().with(&Arrows).with(&Shouts)
}

#[test]
fn the_generic_tests_find_them() {
    trial::imports(&imports());
    trial::exports(&exports(), &imports());
}

#[test]
#[should_panic(expected = "boasts: what its example says")]
fn an_example_that_says_something_else_is_found() {
    trial::imports(&traces::imports().with(&Boasts));
}

#[test]
#[should_panic(expected = "din: what its example is taken for")]
fn a_format_that_takes_others_for_its_own_is_found() {
    trial::imports(&traces::imports().with(&Grabs));
}

#[test]
#[should_panic(expected = "arrows: what was written is read again")]
fn a_writer_that_leaves_out_what_it_says_it_carries_is_found() {
    trial::exports(&Registry::new("format", &[&Forgets as &dyn TraceExport]), &imports());
}

#[test]
fn the_help_and_the_errors_of_pm_view_have_them() {
    let ask = |words: &[&str]| view::program(&exports()).run(words, view::run);
    let help = ask(&["--help"]).help().expect("it was asked for");
    assert!(help.contains("- arrows:") && help.contains("An arrow from memory or to it, address and size"), "{help}");
    assert!(help.contains("Addresses, very loud"), "{help}");
    let short = ask(&["-h"]).help().expect("it was asked for");
    // Long lines are wrapped.
    let short = short.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(short.contains("ramulator2, arrows, shouts]"), "{short}");
    // What is only read is not written.
    for word in ["nosuch", "beads"] {
        let outcome = ask(&["--export", word]);
        assert_eq!(outcome.code(), 2);
        let said = outcome.said();
        assert!(said.contains(&format!("'{word}'")) && said.contains("ramulator2, arrows, shouts]"), "{said}");
    }
}

#[test]
fn pm_cachesim_reads_them() {
    let run = |words: &[&str]| {
        let registries = cachesim::Registries { imports: imports(), ..Default::default() };
        let mut table = vec![];
        let outcome = cachesim::program(&registries).run(words, |args, typed| {
            table = cachesim::run(&args, typed, &registries)?.unwrap_or_default();
            Ok(())
        });
        (outcome, String::from_utf8(table).expect("text"))
    };
    let help = run(&["--help"]).0.help().expect("it was asked for");
    assert!(help.contains("- beads:") && help.contains("Numbers of 16 bits on a string"), "{help}");
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("beads 2 and the address that of a word"), "{help}");
    // What is only written is not read.
    for word in ["nosuch", "shouts"] {
        let outcome = run(&["--input", word, "x"]).0;
        assert_eq!(outcome.code(), 2);
        let said = outcome.said();
        assert!(said.contains(&format!("'{word}'")) && said.contains("ramulator2, arrows, beads]"), "{said}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("a file");
        path.display().to_string()
    };
    let (arrows, beads) = (file("a", Arrows.example().input), file("b", Beads.example().input));
    let question = ["--cache", "1K,full,64,lru", "--format", "csv"];
    for (words, fetches) in [(vec![&*arrows], "3"), (vec!["--input", "beads", &beads], "2")] {
        let (outcome, csv) = run(&[&question[..], &words].concat());
        assert_eq!((outcome.code(), outcome.said()), (0, String::new()));
        let mut lines = csv.lines().map(|line| line.rsplit(',').collect::<Vec<_>>());
        let (names, values) = (lines.next().expect("names"), lines.next().expect("a row"));
        let at = names.iter().position(|name| *name == "fetches").expect("a column");
        assert_eq!(values[at], fetches, "{csv}");
    }
}

#[derive(Default)]
struct Count(u64);

impl TraceSink for Count {
    fn access(&mut self, _: Access) {
        self.0 += 1;
    }
}

#[test]
fn pm_view_writes_them_and_they_are_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let [trace, arrows, shouts] = ["t.pmt", "t.arrows", "t.shouts"].map(|name| folder.path().join(name));
    fs::write(&trace, trace_of(3)).expect("a trace");
    for (word, file) in [("darts", &arrows), ("shouts", &shouts)] {
        let words = ["--export".as_ref(), word.as_ref(), trace.as_os_str(), "-o".as_ref(), file.as_os_str()];
        let outcome = view::program(&exports()).run(words, view::run);
        assert_eq!((outcome.code(), outcome.said()), (0, String::new()));
    }
    assert_eq!(fs::read_to_string(&arrows).expect("text"), "<1000 20\n<1014 20\n<1028 20\n");
    assert_eq!(fs::read_to_string(&shouts).expect("text"), "0x1000!\n0x1014!\n0x1028!\n");
    // By its first line, for nobody says what it is.
    let input = BufReader::new(fs::File::open(&arrows).expect("a file"));
    let Ok(Opened::Foreign(mut read)) = traces::open(input, &Reading::plain(), &imports()) else { panic!("not known") };
    let mut count = Count::default();
    read.replay(&mut count).expect("accesses");
    assert_eq!((read.format().word(), count.0), ("arrows", 3));
}

/// A trace of a search that reads so many records.
fn trace_of(records: u64) -> Vec<u8> {
    let mut header = Header::empty();
    header.regions = lay_out([("a".into(), 2000, 20, Coding::Records)]);
    let mut encoder = BlockEncoder::new(&header.regions);
    encoder.begin(&[0]);
    (0..records).for_each(|record| encoder.access(Access::read(0, 20 * record, 20)));
    encoder.end();
    let (block, tally) = encoder.finish(BlockMeta::default()).expect("a block");
    let mut writer = TraceWriter::new(vec![], &header).expect("a stream");
    writer.write(&block, tally).expect("a block");
    writer.finish(vec![]).expect("an end")
}

#[test]
fn the_documentation_has_their_rows() {
    let table = traces::table(&imports(), &exports());
    for row in [
        "| `arrows` | An arrow from memory or to it, address and size | as it says | yes | yes |\n",
        "| `beads` | Numbers of 16 bits on a string | 2, and the address that of a word | yes |  |\n",
        "| `shouts` | Addresses, very loud | | | yes |\n",
    ] {
        assert!(table.contains(row), "{row}{table}");
    }
    assert!(traces::assumed_sizes(&imports()).contains("beads 2 and the address that of a word"));
}
