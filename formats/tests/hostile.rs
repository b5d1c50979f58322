//! Is what would cost time or memory refused before it does, though every checksum is right?

use pm_formats::{
    Block, BlockMeta, BlockWriter, Header, IrradianceRay, IrradianceRecord, Query, RecordReader, Section, Step,
    StreamKind, decode_irradiance, decode_weights, encode_irradiance, tally_beside,
};
use std::time::{Duration, Instant};
use xxhash_rust::xxh3::xxh3_64;

/// A stream of queries with this header and these blocks beside the queries, each as bytes.
fn stream(header: &Header, blocks: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = BlockWriter::new(vec![], StreamKind::Queries, header).unwrap().finish(&Default::default()).unwrap();
    let at = 24 + u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    bytes.splice(at..at, blocks.concat());
    bytes
}

/// A block of a section by its offsets: so many rows, this payload.
fn block(section: Section, rows: u32, payload: &[u8]) -> Vec<u8> {
    let mut bytes = b"PMBL".to_vec();
    bytes.extend([section as u8, 0, 0, 0]);
    bytes.extend(0u64.to_le_bytes());
    bytes.extend(rows.to_le_bytes());
    bytes.extend([payload.len() as u32; 2].iter().flat_map(|len| len.to_le_bytes()));
    let sum = xxh3_64(&bytes).to_le_bytes();
    bytes.extend(&sum[..4]);
    bytes.extend(xxh3_64(payload).to_le_bytes());
    bytes.extend(payload);
    bytes
}

/// Reads a stream of queries, and what stands beside them, as the programs do.
fn read(bytes: &[u8]) -> pm_formats::Result<Vec<Block>> {
    let mut reader = RecordReader::<Query, _>::new(bytes)?;
    while reader.next_block()?.is_some() {}
    Ok(reader.take_beside().into_iter().map(|(block, _)| block).collect())
}

#[track_caller]
fn refused_at_once(bytes: &[u8]) {
    let start = Instant::now();
    let outcome = read(bytes);
    assert!(outcome.as_ref().is_err_and(pm_formats::Error::is_damage), "{outcome:?}");
    assert!(start.elapsed() < Duration::from_secs(1));
}

fn row(strata: [u32; 2]) -> Vec<u8> {
    let mut words = [0u32; 10];
    words[8..].copy_from_slice(&strata);
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

#[test]
fn strata_whose_product_is_beyond_any_number_are_none() {
    // One row without rays: 2^31 x 2^31 rays of 4 words are 0 modulo 2^64, 2^16 x 2^16 are 0 modulo 2^32.
    for strata in [[1 << 31, 1 << 31], [1 << 16, 1 << 16], [u32::MAX, u32::MAX], [0, 5]] {
        let mut reader = pm_formats::BlockReader::new(&*stream(
            &Header::empty(),
            &[block(Section::IrradianceRecords, 1, &row(strata))],
        ))
        .map(|mut reader| reader.next_block().unwrap().unwrap())
        .unwrap();
        assert!(decode_irradiance(&reader).is_none(), "{strata:?}");
        reader.section = Section::PixelWeights;
        assert!(decode_weights(&reader).is_none());
    }
    // A sound one is read.
    let ray = IrradianceRay { length: 1.0, light: [0.0; 3] };
    let sound = IrradianceRecord {
        pixel: 0,
        position: [0.0; 3],
        normal: [0.0, 1.0, 0.0],
        radius: 1.0,
        strata: [2, 3],
        rays: vec![ray; 6],
    };
    let (block, _) = encode_irradiance(std::slice::from_ref(&sound)).unwrap();
    assert_eq!(decode_irradiance(&block).unwrap().0, [sound]);
}

#[test]
fn rows_without_bytes_cost_nothing() {
    for section in [Section::IrradianceRecords, Section::PixelWeights, Section::Records] {
        refused_at_once(&stream(&Header::empty(), &[block(section, u32::MAX, &[])]));
        refused_at_once(&stream(&Header::empty(), &[block(section, 1 << 20, &[0; 8])]));
    }
    let (empty, tally) = encode_irradiance(&[]).unwrap();
    assert_eq!((empty.meta, tally_beside(&empty)), (BlockMeta::default(), Some(tally)));
}

#[test]
fn an_image_beyond_the_limit_is_refused() {
    for (image, sound) in [([1 << 14, 1 << 14], true), ([65_535, 65_535], false), ([u32::MAX, u32::MAX], false)] {
        let bytes = stream(&Header { image, ..Header::empty() }, &[]);
        assert_eq!(read(&bytes).is_ok(), sound, "{image:?}");
        if !sound {
            refused_at_once(&bytes);
        }
    }
}

#[test]
fn a_history_is_not_deeper_than_the_stack() {
    let nested = |depth: usize| {
        let step = |inputs| Step {
            program: "pm-x".into(),
            version: "1".into(),
            arguments: vec![],
            seed: None,
            input: None,
            inputs,
        };
        let innermost = step(vec![]);
        (0..depth).fold(innermost, |inner, _| step(vec![("x.pmp".to_owned(), vec![inner])]))
    };
    let with = |depth| stream(&Header { history: vec![nested(depth)], ..Header::empty() }, &[]);
    assert!(read(&with(60)).is_ok());
    refused_at_once(&with(70));
    refused_at_once(&with(3000));
    // The one that was refused does not count for the next.
    assert!(read(&with(60)).is_ok());
}
