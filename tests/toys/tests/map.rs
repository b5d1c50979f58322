//! Is a photon map one file and one line?

#[path = "map/broken.rs"]
mod broken;
#[path = "map/rows.rs"]
mod rows;

use pm_formats::trace::TraceReader;
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{BlockMeta, Bounds, Header, Material, Number, Query, Record, RecordWriter, StageReport};
use pm_maps::{LINE, Structure, trial};
use pm_registry::Registry;
use std::fs::File;

/// The structures that there are, and the one line.
fn structures() -> Registry<dyn Structure> {
    pm_maps::structures().with(&rows::Rows)
}

#[test]
fn it_is_in_every_test_that_says_for_every_map() {
    let lines: Vec<_> = trial::forms(&structures()).unwrap().into_iter().map(|form| form.line).collect();
    assert!(lines.ends_with(&["rows".into(), "rows --axis 2".into()]), "{lines:?}");
    // Those of the crate pass its own tests.
    let own: Registry<dyn Structure> = Registry::new("map", &[&rows::Rows]);
    trial::all(&own.with_common(&[LINE])).unwrap();
}

#[test]
fn a_broken_one_is_caught() {
    for (broken, said) in [
        (&broken::Hasty as &'static dyn Structure, "other neighbours than brute force"),
        (&broken::Stray, "stray: reads record Some(3000) of photons of 3000"),
        (&broken::Careless, "careless: a coordinate of NaN is not refused: None"),
    ] {
        let registry: Registry<dyn Structure> = Registry::new("map", &[broken]);
        let fault = trial::all(&registry.with_common(&[LINE])).unwrap_err();
        assert!(fault.to_string().starts_with(broken.word()) && fault.to_string().ends_with(said), "{fault}");
    }
}

#[test]
fn it_is_in_the_help_the_errors_and_the_documentation() {
    let run = |line: &str| pm_programs::gather::run(&structures(), line.split(' '));
    let help = run("--help").help().expect("a help");
    let told = "rows: axis along which the photons are sorted";
    assert!(help.contains("Photons in a row, sorted by one coordinate") && help.contains(told), "{help}");
    let refused = run("--map row");
    assert!(
        refused.code() == 2 && refused.said().contains("reverse, treelets, brute, rows, brick, cell-cache]"),
        "{}",
        refused.said()
    );
    assert_eq!(run("--axis 1").said(), "--axis is for --map rows, not for kd: leave --axis out");
    assert!(structures().table().ends_with("| `rows` | Photons in a row, sorted by one coordinate | `--axis` |\n"));
}

#[test]
fn it_runs() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let header = Header {
        bounds: Bounds { min: [0.0; 3], max: [1.0; 3] },
        image: [10, 10],
        materials: vec![Material { name: "paint".into(), diffuse: [0.5; 3], specular: [0.0; 3], exponent: 0.0 }],
        ..Header::empty()
    };
    let photons = trial::photons(trial::random_points(500, |[x, _, z]| [x, 0.0, z]));
    let emitted = StageReport::new("toy").with(measure::EMITTED_PATHS, Number::Count(500));
    write(&path("map.pmp"), &header, &photons, vec![emitted]);
    let (normal, view) = Query::pack_vectors([0.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
    let query =
        |(pixel, position)| Query { pixel, position, normal, view, weight: [1.0; 3], sample: 0, material: 0, flags: 0 };
    let queries: Vec<Query> = (0..).zip(trial::random_points(100, |[x, _, z]| [x, 0.0, z])).map(query).collect();
    write(&path("q.pmq"), &header, &queries, vec![]);

    let gather = |map: &str| {
        let [photons, queries, trace, image] = ["map.pmp", "q.pmq", "trace.pmt", "image.exr"].map(path);
        let line = format!("{photons} {queries} --map {map} -k 10 -qo {trace} --image {image}");
        let outcome = pm_programs::gather::run(&structures(), line.split(' '));
        assert_eq!((outcome.code(), outcome.said().as_str()), (0, ""));
        std::fs::read(image).unwrap()
    };
    // The picture is that of any other exact map, to the last bit.
    let picture = gather("kd");
    assert!(picture == gather("rows --axis 2"));
    let trace = TraceReader::new(File::open(path("trace.pmt")).unwrap()).unwrap();
    assert_eq!(trace.header().meaning(meaning::MAP), Some("rows"));
    assert_eq!(trace.header().regions[0].name, "rows");
}

fn write<T: Record>(path: &str, header: &Header, records: &[T], stages: Vec<StageReport>) {
    let mut writer = RecordWriter::new(File::create(path).unwrap(), header).unwrap();
    writer.write(BlockMeta::default(), records).unwrap();
    writer.finish(stages).unwrap();
}
