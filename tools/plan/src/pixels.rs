//! Which pixels are measured: one in each cell of a grid over the picture.

use pm_random::Random;

/// About so many pixels of a picture, one by chance in each cell of a grid, row by row there and back so that neighbours follow
/// one another; all pixels of a small picture.
pub(crate) fn stratified([width, height]: [u32; 2], wanted: u32, seed: u64) -> Vec<[u32; 2]> {
    let ratio = libm::sqrt(f64::from(width) / f64::from(height));
    let side = libm::sqrt(f64::from(wanted));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "roots of small numbers")]
    let cells = |x: f64, most: u32| (libm::round(x) as u32).clamp(1, most);
    let (columns, rows) = (cells(side * ratio, width), cells(side / ratio, height));
    let mut random = Random::new(&[seed, 0x7069_7865_6c73]);
    let mut within = |cell: u32, cells: u32, pixels: u32| {
        let edge = |cell: u32| u64::from(cell) * u64::from(pixels) / u64::from(cells);
        let (from, to) = (edge(cell), edge(cell + 1));
        u32::try_from(from + random.next_u64() % (to - from)).unwrap_or(0)
    };
    let mut pixels = vec![];
    for row in 0..rows {
        for at in 0..columns {
            let column = if row % 2 == 0 { at } else { columns - 1 - at };
            pixels.push([within(column, columns, width), within(row, rows, height)]);
        }
    }
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn each_cell_has_one() {
        let pixels = stratified([200, 100], 200, 1);
        assert_eq!(pixels.len(), 200);
        let cells: BTreeSet<[u32; 2]> = pixels.iter().map(|[x, y]| [x / 10, y / 10]).collect();
        assert_eq!(cells.len(), 200);
        assert!(
            pixels.windows(2).all(|two| two[0][0].abs_diff(two[1][0]) <= 20 && two[0][1].abs_diff(two[1][1]) <= 20)
        );
        assert_ne!(pixels, stratified([200, 100], 200, 2));
    }

    #[test]
    fn a_small_picture_is_taken_whole() {
        let all: BTreeSet<_> = stratified([7, 5], 1000, 3).into_iter().collect();
        assert_eq!(all.len(), 35);
    }
}
