//! Words of records, record by record and column by column.
//!
//! These loops know no type of record, so that they are compiled here and not in each program; they are there for each width that
//! a record of ours has, since a loop that knows its width is the faster one.

use crate::digest::Tally;

/// Records whose words are put into columns, or back, at a time.
const TILE: usize = 128;

/// Words of a photon, a photon that is not rounded, a query: a call for each of them, and for any other width.
macro_rules! for_each_width {
    ($width:ident, $call:expr) => {
        match $width {
            5 => {
                let $width = 5;
                $call
            }
            8 => {
                let $width = 8;
                $call
            }
            11 => {
                let $width = 11;
                $call
            }
            _ => $call,
        }
    };
}

/// The bytes of the words of records, column by column.
pub(super) fn columns(words: &[u32], words_each: usize) -> Vec<u8> {
    let mut bytes = vec![0; size_of_val(words)];
    if let Ok(columns) = bytemuck::try_cast_slice_mut(&mut bytes) {
        for_each_width!(words_each, put_into(words, columns, words_each));
    } else {
        // The system's memory lies askew.
        let mut columns = vec![0; words.len()];
        put_into(words, &mut columns, words_each);
        bytes.copy_from_slice(bytemuck::cast_slice(&columns));
    }
    bytes
}

#[inline(always)]
fn put_into(words: &[u32], columns: &mut [u32], words_each: usize) {
    let records = words.len() / words_each;
    // A few records at a time, which stay near while each column takes its words of them.
    for (from, tile) in (0..).step_by(TILE).zip(words.chunks(TILE * words_each)) {
        for (column, values) in columns.chunks_exact_mut(records.max(1)).enumerate() {
            for (value, record) in values[from..].iter_mut().zip(tile.chunks_exact(words_each)) {
                *value = record[column];
            }
        }
    }
}

/// The words of columns, record by record, into as many words.
pub(super) fn put_back(columns: &[u32], words: &mut [u32], words_each: usize) {
    for_each_width!(words_each, take_back(columns, words, words_each));
}

#[inline(always)]
fn take_back(columns: &[u32], words: &mut [u32], words_each: usize) {
    let records = words.len() / words_each;
    for (from, tile) in (0..).step_by(TILE).zip(words.chunks_mut(TILE * words_each)) {
        for (column, values) in columns.chunks_exact(records.max(1)).enumerate() {
            for (record, value) in tile.chunks_exact_mut(words_each).zip(&values[from..]) {
                record[column] = *value;
            }
        }
    }
}

/// The tally of records.
pub(super) fn tally(words: &[u32], words_each: usize) -> Tally {
    for_each_width!(words_each, counted(words, words_each))
}

#[inline(always)]
fn counted(words: &[u32], words_each: usize) -> Tally {
    let mut tally = Tally::default();
    words.chunks_exact(words_each).for_each(|record| tally.count(bytemuck::cast_slice(record)));
    tally
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_put_back_whatever_the_width() {
        for words_each in [1, 5, 7, 8, 11] {
            for records in [0, 1, TILE - 1, TILE, TILE + 1, 3 * TILE + 7] {
                let words: Vec<u32> = (0..(records * words_each) as u32).collect();
                let columns = columns(&words, words_each);
                let expected = (0..words_each).flat_map(|column| (0..records).map(move |at| at * words_each + column));
                let columns: Vec<u32> = bytemuck::pod_collect_to_vec(&columns);
                assert!(columns.iter().copied().eq(expected.map(|at| at as u32)), "{words_each} x {records}");
                let mut back = vec![0; words.len()];
                put_back(&columns, &mut back, words_each);
                assert_eq!(back, words);
                let mut one_by_one = Tally::default();
                words.chunks(words_each).for_each(|record| one_by_one.count(bytemuck::cast_slice(record)));
                assert_eq!(tally(&words, words_each), one_by_one);
            }
        }
    }
}
