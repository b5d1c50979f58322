//! Small streams of each kind, whole and in parts.

use pm_formats::trace::{Access, BlockEncoder, Coding, TraceWriter, Waits, lay_out};
use pm_formats::vocabulary::meaning;
use pm_formats::{
    BlockMeta, Header, IrradianceRay, IrradianceRecord, Material, Photon, PixelWeight, Query, Record, RecordWriter,
    Step, UnroundedPhoton, encode_irradiance, encode_weights,
};

const UP: [f32; 3] = [0.0, 1.0, 0.0];

fn header(part: Option<&str>) -> Header {
    let mut arguments = vec!["-n".to_owned(), "3".to_owned()];
    arguments.extend(part.iter().flat_map(|part| ["--part".to_owned(), (*part).to_owned()]));
    let step =
        Step { program: "pm-x".into(), version: "0".into(), arguments, seed: Some(1), input: None, inputs: vec![] };
    let inputs = vec![("m.pmp".to_owned(), vec![Step { arguments: vec![], ..step.clone() }])];
    let second = Step { program: "pm-y".into(), arguments: vec![], input: Some("q".into()), inputs, ..step.clone() };
    let floor = Material { name: "a".into(), diffuse: [0.5; 3], specular: [0.1; 3], exponent: 9.0 };
    let mut header = Header { image: [4, 4], materials: vec![floor], history: vec![step, second], ..Header::empty() };
    header.set_meaning(meaning::ORDER, "tiled 2x2");
    if let Some(part) = part {
        header.set_meaning(meaning::PART, part);
    }
    header
}

/// Batches of a stream, or of the part of two that is meant.
fn batches(part: Option<&str>) -> Vec<u64> {
    match part {
        Some("1/2") => vec![0, 2],
        Some("2/2") => vec![1, 3],
        _ => vec![0, 1, 2, 3],
    }
}

fn writer<T: Record>(part: Option<&str>) -> RecordWriter<T, Vec<u8>> {
    RecordWriter::new(vec![], &header(part)).expect("a header")
}

pub(super) fn photons() -> Vec<u8> {
    let mut writer = writer(None);
    let photon = Photon::new([0.1, 0.2, 0.3], [1.0; 3], [0.5; 3], UP, UP).expect("a photon");
    writer.write(BlockMeta::default(), &[photon; 3]).expect("memory takes all");
    writer.finish(vec![]).expect("memory takes all")
}

pub(super) fn unrounded() -> Vec<u8> {
    let mut writer = writer(Some("1/1"));
    let photon = UnroundedPhoton::new([0.1, 0.2, 0.3], [1.0; 3], UP, UP, 2);
    writer.write(BlockMeta::default(), &[photon; 3]).expect("memory takes all");
    writer.finish(vec![]).expect("memory takes all")
}

pub(super) fn queries(part: Option<&str>, cached: bool) -> Vec<u8> {
    let mut writer = writer(part);
    if cached {
        let record = IrradianceRecord {
            pixel: 1,
            position: [0.0; 3],
            normal: UP,
            radius: 1.0,
            strata: [1, 2],
            rays: vec![IrradianceRay { length: 1.0, light: [0.5; 3] }; 2],
        };
        let weight =
            PixelWeight { pixel: 1, record: 0, weight: [1.0; 3], displacement: [0.0; 3], normal_change: [0.0; 3] };
        let tables = [encode_irradiance(&[record]), encode_weights(&[weight])];
        for (block, tally) in tables.into_iter().map(|table| table.expect("a block")) {
            writer.write_beside(&block, tally).expect("memory takes all");
        }
    }
    let (normal, view) = Query::pack_vectors(UP, [0.0, 0.6, 0.8]);
    for (batch, x) in batches(part).into_iter().zip([0.0, 1.0, 2.0, 3.0]) {
        let position = [x, 0.0, 1.0];
        let query = Query { position, normal, view, material: 0, flags: 0, pixel: 2, sample: 0, weight: [0.5; 3] };
        writer.write(BlockMeta { batch, ..BlockMeta::default() }, &[query; 2]).expect("memory takes all");
    }
    writer.finish(vec![]).expect("memory takes all")
}

pub(super) fn trace(part: Option<&str>) -> Vec<u8> {
    let regions = lay_out([
        ("tree".to_owned(), 7 * 20, 20, Coding::HeapWalk { nodes: 7, reread: true }),
        ("list".to_owned(), 4096, 16, Coding::Records),
        ("inner".to_owned(), 4 * 8, 8, Coding::LeavesApart { leaves: 5 }),
        ("leaves".to_owned(), 5 * 64, 64, Coding::Records),
        ("first".to_owned(), 1000, 4, Coding::InTurns),
        ("second".to_owned(), 1000, 20, Coding::InTurns),
        ("third".to_owned(), 1000, 128, Coding::InTurns),
    ]);
    let header = Header { regions, ..header(part) };
    let mut writer = TraceWriter::new(vec![], &header).expect("a header");
    for batch in batches(part) {
        let mut encoder = BlockEncoder::new(&header.regions);
        for pixel in 0..3 {
            encoder.begin(&[pixel]);
            encoder.records(0, &[0, 1, 3, 4]);
            encoder.records(1, &[pixel * 4, 9]);
            encoder.access(Access::read(1, 77, 5));
            [(2, 0), (2, 1), (2, 3), (3, 3), (3, 4), (4, 200), (6, 3), (4, 201)]
                .iter()
                .for_each(|&(region, record)| encoder.records(region, &[record]));
            encoder.end();
        }
        let (block, tally) = encoder.finish(BlockMeta { batch, ..BlockMeta::default() }).expect("a block");
        writer.write(&block, tally).expect("memory takes all");
    }
    writer.finish(vec![]).expect("memory takes all")
}

/// A trace whose reads say what they wait for.
pub(super) fn waits() -> Vec<u8> {
    let regions = lay_out([16, 64].map(|size| ("blocks".to_owned(), 6400, size, Coding::Waiting)));
    let header = Header { regions, ..header(None) };
    let mut writer = TraceWriter::new(vec![], &header).expect("a header");
    let mut encoder = BlockEncoder::new(&header.regions);
    for search in 0..3 {
        encoder.begin(&[search]);
        encoder.waiting_records(0, &[9, 10 + search], &[Waits::NOTHING, Waits::last_above(1)]);
        encoder.waiting_records(1, &[3], &[Waits::all_above(2)]);
        encoder.waiting_records(0, &[9], &[Waits::ALL_BEFORE]);
        encoder.end();
    }
    let (block, tally) = encoder.finish(BlockMeta::default()).expect("a block");
    writer.write(&block, tally).expect("memory takes all");
    writer.finish(vec![]).expect("memory takes all")
}

/// A trace of walks alone, of a tree small enough for its tables and with searches enough for an archive to code them.
pub(super) fn walks() -> Vec<u8> {
    let regions = lay_out([("tree".to_owned(), 31 * 20, 20, Coding::HeapWalk { nodes: 31, reread: true })]);
    let header = Header { regions, ..header(None) };
    let mut writer = TraceWriter::new(vec![], &header).expect("a header");
    let mut encoder = BlockEncoder::new(&header.regions);
    // Each search does at each node what the one before did, but for some chance (Knuth's constants of a linear congruential
    // generator): which child is first, and is the other visited?
    let (mut random, mut does) = (1u64, [0u8; 31]);
    for search in 0..WALKS {
        let mut path = vec![];
        let mut ahead = vec![0u32];
        while let Some(node) = ahead.pop() {
            path.push(node);
            if node >= 15 {
                continue;
            }
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let does = &mut does[node as usize];
            if random >> 60 == 0 {
                *does = (random >> 50) as u8 & 3;
            }
            let first = 2 * node + 1 + u32::from(*does & 1);
            let second = 4 * node + 3 - first;
            ahead.extend((*does & 2 != 0).then_some(second));
            ahead.push(first);
        }
        encoder.begin(&[search]);
        encoder.records(0, &path);
        encoder.end();
    }
    let (block, tally) = encoder.finish(BlockMeta::default()).expect("a block");
    writer.write(&block, tally).expect("memory takes all");
    writer.finish(vec![]).expect("memory takes all")
}

/// Searches of the trace of walks.
const WALKS: u32 = 2600;
