//! Is an order one file and one line?

#[path = "order/backwards.rs"]
mod backwards;
#[path = "order/broken.rs"]
mod broken;

use pm_formats::{BlockMeta, Header, Material, Query, RecordReader, RecordWriter};
use pm_orders::{Order, trial};
use pm_registry::Registry;
use std::path::Path;

/// The orders that there are, and the one line.
fn orders() -> Registry<dyn Order> {
    pm_orders::orders().with(&backwards::Backwards)
}

#[test]
fn it_is_in_every_test_that_says_for_every_order() {
    let lines: Vec<_> = trial::forms(&orders()).unwrap().into_iter().map(|form| form.line).collect();
    assert!(lines.ends_with(&["backwards".into(), "backwards --twice".into()]), "{lines:?}");
    trial::all(&orders()).unwrap();
}

#[test]
fn a_broken_one_is_caught() {
    for (broken, said) in [
        (
            &broken::Forgetful as &'static dyn Order,
            "forgetful: 1 queries, anywhere: what comes out is not what went in",
        ),
        (&broken::Late, "late: 1 queries, anywhere: what comes out is not what went in"),
        (&broken::Modest, "modest: 1 queries were held, 0 are told"),
    ] {
        let fault = trial::all(&Registry::new("order", &[broken])).unwrap_err();
        assert_eq!(fault.to_string(), said);
    }
}

#[test]
fn it_is_in_the_help_the_errors_and_the_documentation() {
    let run = |line: &str| pm_programs::reorder::run(&orders(), line.split(' '));
    let help = run("--help").help().expect("a help");
    assert!(help.contains("- backwards: Last in, first out"), "{help}");
    assert!(help.contains("--twice") && help.contains("backwards: turn them round again"), "{help}");
    let refused = run("forwards");
    assert!(refused.code() == 2 && refused.said().contains("snowplow, buffered, backwards]"), "{}", refused.said());
    let refused = run("hilbert --twice");
    assert_eq!(refused.said(), "--twice is for backwards, not for hilbert: leave --twice out");
    assert!(orders().table().ends_with("| `backwards` | Last in, first out | `--twice` |\n"));
}

#[test]
fn it_runs() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let queries = trial::queries(1000, |random| [(); 3].map(|()| random.unit()));
    let paint = Material { name: "paint".into(), diffuse: [0.5; 3], specular: [0.0; 3], exponent: 0.0 };
    let header = Header { image: [25, 10], materials: vec![paint], ..Header::empty() };
    let mut writer = RecordWriter::new(std::fs::File::create(path("q.pmq")).unwrap(), &header).unwrap();
    queries.chunks(300).for_each(|block| writer.write(BlockMeta::default(), block).unwrap());
    writer.finish(vec![]).unwrap();
    let outcome =
        pm_programs::reorder::run(&orders(), ["backwards", &path("q.pmq"), "--storage", "4K", "-qo", &path("out.pmq")]);
    assert_eq!((outcome.code(), outcome.said().as_str()), (0, ""));
    let (header, got) = read(Path::new(&path("out.pmq")));
    assert!(got.into_iter().rev().eq(queries));
    assert_eq!(header.meaning(pm_formats::vocabulary::meaning::DEFERRED_ORDER), Some("backwards"));
}

fn read(path: &Path) -> (Header, Vec<Query>) {
    let mut reader = RecordReader::<Query, _>::new(std::fs::File::open(path).unwrap()).unwrap();
    let mut queries = vec![];
    while let Some((_, block)) = reader.next_block().unwrap() {
        queries.extend(block);
    }
    (reader.header().clone(), queries)
}
