//! Whole streams of each kind, so short that every byte can be tried.

use crate::support::Folder;
use pm_formats::trace::{BlockEncoder, Coding, Region, TraceWriter, Waits, lay_out};
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{
    BlockMeta, Bounds, Header, Material, Number, Photon, Query, Record, RecordWriter, StageReport, Step, StreamKind,
    UnroundedPhoton,
};

/// Records of each of the three blocks.
const EACH: u32 = 4;

/// A stream of this kind: a header, three blocks of four records, an end block; about a kilobyte.
pub(super) fn specimen(kind: StreamKind) -> Vec<u8> {
    match kind {
        StreamKind::Photons => written(photon),
        StreamKind::Queries => written(query),
        StreamKind::Trace => trace(Coding::InTurns),
        StreamKind::UnroundedPhotons => part(),
    }
}

/// A trace like [`specimen`]'s, whose reads in turns also say what they wait for.
pub(super) fn waiting_trace() -> Vec<u8> {
    trace(Coding::Waiting)
}

/// What `pm-cachesim` prints of a trace in a folder.
pub(super) fn table_of(folder: &Folder, name: &str) -> String {
    folder.run(&format!("pm-cachesim {name}")).ok().text().to_owned()
}

/// A number in [0, 1] that looks random, so that blocks do not shrink to nothing.
fn number(seed: u32) -> f32 {
    (seed.wrapping_mul(2_654_435_761) >> 8) as f32 / (1u32 << 24) as f32
}

fn photon(i: u32) -> Photon {
    let position = [number(i), 0.0, number(i + 100)];
    Photon::new(position, [0.5; 3], [0.5; 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]).expect("a photon")
}

fn query(i: u32) -> Query {
    let (normal, view) = Query::pack_vectors([0.0, 1.0, 0.0], [0.0, 0.6, 0.8]);
    let position = [number(i + 200), 0.0, number(i + 300)];
    Query { position, normal, view, material: 0, flags: 0, pixel: i, sample: i % 3, weight: [0.5; 3] }
}

fn header(program: &str) -> Header {
    let step = Step {
        program: program.into(),
        version: "0".into(),
        arguments: vec!["-n".into(), "12".into()],
        seed: Some(0),
        input: None,
        inputs: vec![],
    };
    let floor = Material { name: "floor".into(), diffuse: [0.5; 3], specular: [0.0; 3], exponent: 0.0 };
    let bounds = Bounds { min: [0.0; 3], max: [1.0; 3] };
    Header { bounds, image: [4, 3], materials: vec![floor], history: vec![step], ..Header::empty() }
}

fn stages(program: &str) -> Vec<StageReport> {
    vec![StageReport::new(program).with(measure::EMITTED_PATHS, Number::Count(12))]
}

fn written<T: Record>(record: impl Fn(u32) -> T) -> Vec<u8> {
    let mut writer = RecordWriter::new(vec![], &header("pm-x")).expect("a header");
    for batch in 0..3 {
        let records: Vec<T> = (0..EACH).map(|i| record(batch * EACH + i)).collect();
        let meta = BlockMeta { batch: batch.into(), ..BlockMeta::default() };
        writer.write(meta, &records).expect("a block");
    }
    writer.finish(stages("pm-x")).expect("an end block")
}

/// The only part of a stream of twelve photons.
fn part() -> Vec<u8> {
    let mut header = Header { expected_records: Some(12), ..header("pm-x") };
    header.set_meaning(meaning::PART, "1/1");
    let mut writer = RecordWriter::new(vec![], &header).expect("a header");
    for batch in 0..3 {
        let position = |i| [number(batch * EACH + i), 0.0, number(i + 100)];
        let photon = |i| UnroundedPhoton::new(position(i), [number(i); 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0], i * 9);
        let photons: Vec<UnroundedPhoton> = (0..EACH).map(photon).collect();
        let meta = BlockMeta { batch: batch.into(), ..BlockMeta::default() };
        writer.write(meta, &photons).expect("a block");
    }
    let stage = StageReport::new("pm-x").with(measure::PATHS_TRACED, Number::Count(3 * 4096));
    writer.finish(vec![stage]).expect("an end block")
}

/// A trace with regions of every coding, two of them coded by `in_turns`.
fn trace(in_turns: Coding) -> Vec<u8> {
    let regions: Vec<Region> = lay_out([
        ("tree".to_owned(), 7 * 20, 20, Coding::HeapWalk { nodes: 7, reread: false }),
        ("list".to_owned(), 4096, 16, Coding::Records),
        ("splits".to_owned(), 16, 8, Coding::LeavesApart { leaves: 3 }),
        ("leaves".to_owned(), 384, 128, Coding::Records),
        ("buckets".to_owned(), 4096, 64, in_turns.clone()),
        ("blocks".to_owned(), 4096, 64, in_turns),
    ]);
    let header = Header { regions, ..header("pm-gather") };
    let mut writer = TraceWriter::new(vec![], &header).expect("a header");
    for batch in 0..3 {
        let mut encoder = BlockEncoder::new(&header.regions);
        for i in 0..EACH {
            encoder.begin(&[batch * EACH + i]);
            encoder.records(0, &[0, 1, 3, 4][..1 + i as usize % 4]);
            encoder.records(1, &[i * 40, batch, 255 - i]);
            encoder.records(2, &[0, 1]);
            encoder.records(3, &[1, 2]);
            encoder.waiting_records(4, &[i, 9], &[Waits::NOTHING, Waits::last_above(1)]);
            encoder.waiting_records(5, &[7 * i], &[Waits::all_above(2)]);
            encoder.end();
        }
        let meta = BlockMeta { batch: batch.into(), ..BlockMeta::default() };
        let (block, tally) = encoder.finish(meta).expect("a block");
        writer.write(&block, tally).expect("room for a block");
    }
    writer.finish(stages("pm-gather")).expect("an end block")
}
