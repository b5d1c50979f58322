//! Several streams, put together as parts of one.

use super::mend::{mended, whole};
use super::streams::Sum;
use pm_formats::{BlockReader, BlockWriter, Parts};

/// The bytes are cut where they say: a number of pieces, and two bytes of length before each.
pub(super) fn together(data: &[u8]) {
    let Some((&number, mut rest)) = data.split_first() else { return };
    let mut pieces = vec![];
    for _ in 0..number % 5 {
        let Some((length, behind)) = rest.split_at_checked(2) else { break };
        let length = usize::from(u16::from_le_bytes([length[0], length[1]])).min(behind.len());
        let (piece, behind) = behind.split_at(length);
        pieces.push(mended(piece));
        rest = behind;
    }
    put_together(&pieces);
    let wholes: Option<Vec<_>> = pieces.iter().map(|piece| whole(piece)).collect();
    put_together(&wholes.unwrap_or_default());
}

fn put_together(pieces: &[Vec<u8>]) {
    let opened: Option<Vec<_>> =
        pieces.iter().map(|piece| Some(("part".to_owned(), BlockReader::new(&piece[..]).ok()?))).collect();
    let Some(Ok(mut parts)) = opened.map(Parts::new) else { return };
    let mut writer =
        BlockWriter::new(vec![], parts.kind(), parts.header()).expect("a header that was read can be written");
    while let Ok(Some(block)) = parts.next_block(&mut Sum::default()) {
        writer.write(&block).expect("memory takes all");
    }
    let Ok(end) = parts.end() else { return };
    let whole = writer.finish(&end).expect("memory takes all");
    let mut blocks = BlockReader::new(&whole[..]).expect("the whole is a stream");
    while blocks.next_block().expect("the whole is whole").is_some() {}
    blocks.end(end.tally).expect("the whole has the records of its parts");
}
