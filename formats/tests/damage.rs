//! Is a stream with tables beside its queries refused when it is cut anywhere, or any bit of it is flipped?

use pm_formats::{
    BlockMeta, Header, IrradianceRay, IrradianceRecord, Material, PixelWeight, Query, RecordReader, RecordWriter,
    Tally, encode_irradiance, encode_weights,
};

fn stream() -> Vec<u8> {
    let mut header = Header::empty();
    header.image = [2, 1];
    header.materials = vec![Material { name: "m".into(), diffuse: [0.5; 3], specular: [0.0; 3], exponent: 0.0 }];
    let mut writer = RecordWriter::new(vec![], &header).unwrap();
    let ray = IrradianceRay { length: 0.5, light: [0.0, 0.25, 1.0] };
    let record = IrradianceRecord {
        pixel: 0,
        position: [0.1, 0.2, 0.3],
        normal: [0.0, 1.0, 0.0],
        radius: 0.4,
        strata: [1, 2],
        rays: vec![ray; 2],
    };
    let weight =
        PixelWeight { pixel: 1, record: 0, weight: [0.3; 3], displacement: [0.01, 0.0, 0.02], normal_change: [0.0; 3] };
    let (block, tally) = encode_irradiance(&[record]).unwrap();
    writer.write_beside(&block, tally).unwrap();
    let (block, tally) = encode_weights(&[weight]).unwrap();
    writer.write_beside(&block, tally).unwrap();
    let (normal, view) = Query::pack_vectors([0.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
    let query = |sample: u32| Query {
        position: [0.5; 3],
        normal,
        view,
        material: 0,
        flags: Query::FOR_RECORD,
        pixel: 0,
        sample,
        weight: [1.0; 3],
    };
    writer.write(BlockMeta::default(), &[query(0), query(1)]).unwrap();
    writer.finish(vec![]).unwrap()
}

/// Reads all of a stream; its tally and the number of blocks beside the queries.
fn read(bytes: &[u8]) -> pm_formats::Result<(Tally, usize)> {
    let mut reader = RecordReader::<Query, _>::new(bytes)?;
    let mut beside = 0;
    while reader.next_block()?.is_some() {
        beside += reader.take_beside().len();
    }
    Ok((reader.end()?.tally, beside + reader.take_beside().len()))
}

#[test]
fn whole_it_is_read() {
    let (tally, beside) = read(&stream()).unwrap();
    assert_eq!((tally.records, beside), (2, 2));
}

#[test]
fn cut_anywhere_it_is_refused() {
    let whole = stream();
    for len in 0..whole.len() {
        assert!(read(&whole[..len]).is_err_and(|error| error.is_damage()), "cut at {len}");
    }
}

#[test]
fn with_any_bit_flipped_it_is_refused() {
    let mut bytes = stream();
    for bit in 0..bytes.len() * 8 {
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(read(&bytes).is_err_and(|error| error.is_damage()), "bit {bit}");
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
}

#[test]
fn without_one_of_its_tables_the_digest_tells() {
    // Whole blocks left out keep every checksum but the digest.
    let whole = stream();
    let starts: Vec<usize> = (0..whole.len() - 4).filter(|&at| &whole[at..at + 4] == b"PMBL").collect();
    assert_eq!(starts.len(), 4);
    for pair in starts[..3].windows(2) {
        let without = [&whole[..pair[0]], &whole[pair[1]..]].concat();
        assert!(read(&without).is_err_and(|error| error.is_damage()));
    }
}
