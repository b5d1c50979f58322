//! Are the bytes those that `README.md` specifies? Read here by offsets, without the library's reader.

use pm_formats::trace::{BlockEncoder, Coding, TraceWriter, Waits, lay_out};
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{BlockMeta, Header, Number, Photon, Query, RecordWriter, StageReport, Step};
use xxhash_rust::xxh3::{xxh3_64, xxh3_128};

fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes(bytes[at..at + 2].try_into().unwrap())
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
}

/// A block by its offsets: section, flags, batch, records, payload; and what follows it.
fn block(bytes: &[u8]) -> (u8, u8, u64, u32, Vec<u8>, &[u8]) {
    assert_eq!(&bytes[..4], b"PMBL");
    assert_eq!(bytes[28..32], xxh3_64(&bytes[..28]).to_le_bytes()[..4]);
    let (raw, stored) = (u32_at(bytes, 20) as usize, u32_at(bytes, 24) as usize);
    let payload = &bytes[40..40 + stored];
    assert_eq!(u64_at(bytes, 32), xxh3_64(payload));
    let payload = if bytes[6] == 1 { zstd::bulk::decompress(payload, raw).unwrap() } else { payload.to_vec() };
    assert_eq!(payload.len(), raw);
    (bytes[4], bytes[5], u64_at(bytes, 8), u32_at(bytes, 16), payload, &bytes[40 + stored..])
}

/// Checks the header by its offsets; the header record, and the blocks after it.
fn header(bytes: &[u8], kind: u16) -> (&[u8], &[u8]) {
    assert_eq!(bytes[..8], [0x89, 0x50, 0x4d, 0x53, 0x0d, 0x0a, 0x1a, 0x0a]);
    assert_eq!((u16_at(bytes, 8), u16_at(bytes, 10)), (2, kind));
    let len = u32_at(bytes, 12) as usize;
    let record = &bytes[24..24 + len];
    assert_eq!(u64_at(bytes, 16), xxh3_64(&[&bytes[..16], record].concat()));
    (record, &bytes[24 + len..])
}

fn sample_header() -> Header {
    let mut header = Header::empty();
    header.bounds.min = [-1.0, 0.0, 0.5];
    header.image = [3, 2];
    header.expected_records = Some(7);
    header.materials.push(pm_formats::Material {
        name: "paint".into(),
        diffuse: [0.5; 3],
        specular: [0.0; 3],
        exponent: 0.0,
    });
    header.set_meaning(meaning::ORDER, "scanline");
    header.history.push(Step {
        program: "pm-x".into(),
        version: "1".into(),
        arguments: vec!["-n".into(), "5".into()],
        seed: Some(9),
        input: None,
        inputs: vec![],
    });
    header
}

#[test]
fn header_and_end_block_of_photons() {
    let photon = Photon::new([1.0, 2.0, 3.0], [1.0, 0.5, 0.0], [0.9; 3], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]).unwrap();
    let mut writer = RecordWriter::new(vec![], &sample_header()).unwrap();
    let meta = BlockMeta { batch: 5, warm_up: true, records: 0 };
    writer.write(meta, &[photon, photon.with_axis(2)]).unwrap();
    let stage = StageReport::new("pm-x").with(measure::EMITTED_PATHS, Number::Count(11));
    let stream = writer.finish(vec![stage]).unwrap();

    let (record, rest) = header(&stream, 1);
    // Bounds, image, then the list of materials.
    assert_eq!(record[..4], (-1f32).to_le_bytes());
    assert_eq!((u32_at(record, 24), u32_at(record, 28), u64_at(record, 32)), (3, 2, 1));
    assert_eq!((u64_at(record, 40), &record[48..53]), (5, &b"paint"[..]));
    // 7 floats of the material, the expected records, one meaning.
    assert_eq!((record[81], u64_at(record, 82), u64_at(record, 90)), (1, 7, 1));
    let end_of_record = &record[record.len() - 9 - 1 - 8..];
    // The seed, no input file, no inputs.
    assert_eq!((end_of_record[0], u64_at(end_of_record, 1), end_of_record[9], u64_at(end_of_record, 10)), (1, 9, 0, 0));

    let (section, flags, batch, records, payload, rest) = block(rest);
    assert_eq!((section, flags, batch, records), (0, 1, 5, 2));
    // By words: both x, both y, both z, both powers, both last words.
    let words: Vec<u32> = payload.chunks(4).map(|word| u32_at(word, 0)).collect();
    assert_eq!(words[..6], [1f32, 1.0, 2.0, 2.0, 3.0, 3.0].map(f32::to_bits));
    assert_eq!(words[6].to_le_bytes(), [128, 64, 0, 129]);
    // Direction +y: (0, 1) is (127, 254); normal -x: (-1, 0) is (0, 63) above two bits of axis.
    assert_eq!(words[8].to_le_bytes(), [127, 254, 0, 0x7e]);
    assert_eq!(words[9].to_le_bytes(), [127, 254, 2, 0x7e]);

    let (section, _, _, _, end, rest) = block(rest);
    assert_eq!((section, rest.len()), (255, 0));
    // The proof of order: the bytes before the header record, then the header of the one block.
    let (end, order) = end.split_at(end.len() - 8);
    let at = 24 + u32_at(&stream, 12) as usize;
    assert_eq!(u64_at(order, 0), xxh3_64(&[&stream[..24], &stream[at..at + 40]].concat()));
    let digest = [photon, photon.with_axis(2)]
        .iter()
        .fold(0u128, |sum, photon| sum.wrapping_add(xxh3_128(bytemuck::bytes_of(photon))));
    assert_eq!((u64_at(end, 0), u128::from_le_bytes(end[8..24].try_into().unwrap())), (2, digest));
    // One stage of one number, which is a count.
    let numbers = &end[end.len() - 12..];
    assert_eq!((u64_at(end, 24), u32_at(numbers, 0), u64_at(numbers, 4)), (1, 0, 11));
}

#[test]
fn a_query_by_its_offsets() {
    let (normal, view) = Query::pack_vectors([0.0, 0.0, 1.0], [0.0, -1.0, 0.0]);
    let query = Query {
        position: [1.0, 2.0, 3.0],
        normal,
        view,
        material: 513,
        flags: 0,
        pixel: 4,
        sample: 5,
        weight: [0.25, 0.5, 0.75],
    };
    let bytes: &[u8] = bytemuck::bytes_of(&query);
    assert_eq!(bytes.len(), 44);
    assert_eq!((u16_at(bytes, 12), u16_at(bytes, 14)), (32767, 32767));
    assert_eq!((u16_at(bytes, 16), u16_at(bytes, 18)), (32767, 0));
    assert_eq!((u16_at(bytes, 20), u16_at(bytes, 22), u32_at(bytes, 24), u32_at(bytes, 28)), (513, 0, 4, 5));
    assert_eq!(u32_at(bytes, 40), 0.75f32.to_bits());
}

#[test]
fn a_trace_by_its_planes() {
    let mut stream_header = sample_header();
    stream_header.regions = lay_out([
        ("tree".into(), 60, 20, Coding::HeapWalk { nodes: 3, reread: false }),
        ("list".into(), 800, 8, Coding::Records),
    ]);
    let mut encoder = BlockEncoder::new(&stream_header.regions);
    encoder.begin(&[4, 2]);
    // Root, right child, then the left one too: bits 1 (right first) and 1 (the other as well).
    encoder.records(0, &[0, 2, 1]);
    encoder.records(1, &[7, 6]);
    encoder.end();
    let (written, tally) = encoder.finish(BlockMeta::default()).unwrap();
    let mut writer = TraceWriter::new(vec![], &stream_header).unwrap();
    writer.write(&written, tally).unwrap();
    let stream = writer.finish(vec![]).unwrap();

    let (_, rest) = header(&stream, 3);
    let (_, _, _, records, payload, _) = block(rest);
    assert_eq!(records, 1);
    // Two segments: region 0 as a walk (1), region 1 spelled out (2) with 2 accesses.
    let heads = [2, 1, 2, 2];
    // Two pixels: +4 and -2, zigzag.
    let destinations = [2, 8, 3];
    let walks = [0b11];
    // Reads of whole records: +7 and -1, zigzag and doubled.
    let others = [28, 2];
    let lens = [4u32, 3, 1].iter().flat_map(|len| len.to_le_bytes());
    let expected: Vec<u8> = lens.chain(heads).chain(destinations).chain(walks).chain(others).collect();
    assert_eq!(payload, expected);

    let mut search = 2u64.to_le_bytes().to_vec();
    search.extend([4u32, 2].iter().flat_map(|pixel| pixel.to_le_bytes()));
    search.extend(heads.iter().chain(&walks).chain(&others));
    assert_eq!(tally.digest.0, xxh3_128(&search));
}

#[test]
fn what_reads_wait_for_by_its_planes() {
    let regions = lay_out([16, 16].map(|size| (String::new(), 1600, size, Coding::Waiting)));
    let mut encoder = BlockEncoder::new(&regions);
    encoder.begin(&[4]);
    encoder.waiting_records(0, &[9, 10], &[Waits::NOTHING, Waits::last_above(1)]);
    encoder.waiting_records(1, &[3], &[Waits::all_above(2)]);
    encoder.waiting_records(0, &[9], &[Waits::ALL_BEFORE]);
    encoder.end();
    let (written, tally) = encoder.finish(BlockMeta::default()).unwrap();
    let mut stream_header = sample_header();
    stream_header.regions = regions;
    let mut writer = TraceWriter::new(vec![], &stream_header).unwrap();
    writer.write(&written, tally).unwrap();
    let stream = writer.finish(vec![]).unwrap();
    let (_, _, _, _, payload, _) = block(header(&stream, 3).1);
    // 2 level + a, then the read: zigzag differences +9, +1, +3, -1, each above a bit that says which region.
    let others = [0, 36, 2, 4, 5, 13, 1, 2];
    let lens = [3u32, 2, 0].iter().flat_map(|len| len.to_le_bytes());
    let expected: Vec<u8> = lens.chain([1, 1, 4]).chain([1, 8]).chain(others).collect();
    assert_eq!(payload, expected);
}

#[test]
fn reads_that_are_coded_together_by_their_planes() {
    let regions = lay_out([
        ("splits".into(), 16, 8, Coding::LeavesApart { leaves: 3 }),
        ("leaves".into(), 300, 100, Coding::Records),
        ("buckets".into(), 6400, 64, Coding::InTurns),
        ("blocks".into(), 6400, 64, Coding::InTurns),
    ]);
    let mut encoder = BlockEncoder::new(&regions);
    encoder.begin(&[4]);
    // Nodes 1 and 2, leaves 5 and 4: left first (0), right first (1), the left one too (1), and not node 3 (0).
    encoder.records(0, &[0, 1]);
    encoder.records(1, &[2, 1]);
    // Record 9 of the first, 3 and then 1 of the second, 10 of the first.
    encoder.records(2, &[9]);
    encoder.records(3, &[3, 1]);
    encoder.records(2, &[10]);
    encoder.end();
    let (written, tally) = encoder.finish(BlockMeta::default()).unwrap();
    let mut stream_header = sample_header();
    stream_header.regions = regions;
    let mut writer = TraceWriter::new(vec![], &stream_header).unwrap();
    writer.write(&written, tally).unwrap();
    let stream = writer.finish(vec![]).unwrap();

    let (record, rest) = header(&stream, 3);
    let at = record.windows(6).position(|bytes| bytes == b"splits").unwrap();
    // Base, size, bytes of a record, coding 3 with 3 leaves.
    assert_eq!(
        (u64_at(record, at + 14), u32_at(record, at + 22), u32_at(record, at + 26), u32_at(record, at + 30)),
        (16, 8, 3, 3)
    );
    let at = record.windows(6).position(|bytes| bytes == b"blocks").unwrap();
    assert_eq!(u32_at(record, at + 26), 4);

    let (_, _, _, _, payload, _) = block(rest);
    // Two segments: the walk, and four reads in turns.
    let heads = [2, 1, 5, 4];
    let destinations = [1, 8];
    let walks = [0b0110];
    // Zigzag differences +9, +3, -2, +1, each above a bit that says which region.
    let others = [36, 13, 7, 4];
    let lens = [4u32, 2, 1].iter().flat_map(|len| len.to_le_bytes());
    let expected: Vec<u8> = lens.chain(heads).chain(destinations).chain(walks).chain(others).collect();
    assert_eq!(payload, expected);
}
