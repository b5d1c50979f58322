//! Writes a small stream of gather queries and reads it again: `cargo run --example query_stream`.

use pm_formats::vocabulary::{OrderLabel, meaning};
use pm_formats::{BlockMeta, Bounds, Header, Material, Query, RecordReader, RecordWriter, Result, StageReport};
use std::io::{Read, Write};

/// Width and height of the picture.
const SIZE: u32 = 4;

/// Asks once for each pixel of a picture of a white floor, row by row, a row to a batch.
///
/// # Errors
/// If it cannot be written.
pub(crate) fn write<W: Write>(output: W) -> Result<W> {
    let mut header = Header {
        bounds: Bounds { min: [0.0; 3], max: [1.0, 0.0, 1.0] },
        image: [SIZE, SIZE],
        materials: vec![Material { name: "white".into(), diffuse: [0.8; 3], specular: [0.0; 3], exponent: 0.0 }],
        expected_records: Some(u64::from(SIZE * SIZE)),
        ..Header::empty()
    };
    header.set_meaning(meaning::ORDER, OrderLabel::new("scanline"));
    let mut writer = RecordWriter::new(output, &header)?;
    for row in 0..SIZE {
        let query = |column: u32| {
            let up = [0.0, 1.0, 0.0];
            let (normal, view) = Query::pack_vectors(up, up);
            let position = [(column as f32 + 0.5) / SIZE as f32, 0.0, (row as f32 + 0.5) / SIZE as f32];
            let pixel = row * SIZE + column;
            Query { position, normal, view, material: 0, flags: 0, pixel, sample: 0, weight: [1.0; 3] }
        };
        let queries: Vec<Query> = (0..SIZE).map(query).collect();
        writer.write(BlockMeta { batch: row.into(), ..BlockMeta::default() }, &queries)?;
    }
    // Only this makes a stream of it: what is cut before is refused by every reader.
    writer.finish(vec![StageReport::new("query_stream")])
}

/// The queries of a stream, and the order they say they are in.
///
/// # Errors
/// If it is none of queries, or not whole.
pub(crate) fn read(input: impl Read) -> Result<(Option<OrderLabel>, Vec<Query>)> {
    let mut reader = RecordReader::<Query, _>::new(input)?;
    let order = reader.header().meaning(meaning::ORDER).and_then(|text| text.parse().ok());
    let mut queries = vec![];
    while let Some((_, more)) = reader.next_block()? {
        queries.extend(more);
    }
    assert_eq!(reader.end()?.tally.records, queries.len() as u64);
    Ok((order, queries))
}

fn main() -> Result<()> {
    let stream = write(vec![])?;
    let (order, queries) = read(&stream[..])?;
    let order = order.map_or("unknown".into(), |order| order.to_string());
    let (bytes, number) = (stream.len(), queries.len());
    Ok(writeln!(std::io::stdout(), "{bytes} bytes hold {number} queries in order {order}")?)
}
