//! Which pixels are measured, and how much each stands for.

use crate::preview::Preview;
use pm_random::Random;

/// Some pixels of a picture, in an order in which neighbours follow one another.
pub(crate) struct Pixels {
    pub(crate) at: Vec<[u32; 2]>,
    /// How many pixels each stands for, relative to their mean over all pixels: means over pixels are to be weighted by it.
    pub(crate) stand_for: Vec<f64>,
}

impl Pixels {
    /// About so many pixels of a picture: it is cut into as many pieces of the same importance, and of each one pixel is taken by
    /// chance, in proportion to its importance. All pixels of a small picture.
    pub(crate) fn choose(preview: &Preview, wanted: u32, seed: u64) -> Self {
        let [width, height] = preview.size();
        let all = f64::from(width) * f64::from(height);
        if all <= f64::from(wanted) {
            let at: Vec<[u32; 2]> = (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).collect();
            return Self { stand_for: vec![1.0; at.len()], at };
        }
        let total: f64 = snake([width, height], wanted).map(|at| preview.importance(at)).sum();
        let piece = total / f64::from(wanted);
        let mut random = Random::new(&[seed, 0x7069_7865_6c73]);
        let mut next = |number: u32| (f64::from(number) + f64::from(random.unit())) * piece;
        let mut chosen = Self { at: vec![], stand_for: vec![] };
        let (mut passed, mut number) = (0.0, 0);
        let mut mark = next(0);
        for at in snake([width, height], wanted) {
            let importance = preview.importance(at);
            passed += importance;
            while mark < passed && number < wanted {
                chosen.at.push(at);
                chosen.stand_for.push(total / (all * importance));
                number += 1;
                mark = next(number);
            }
        }
        chosen
    }

    pub(crate) const fn len(&self) -> usize {
        self.at.len()
    }
}

/// All pixels, cell by cell of a grid of about as many cells as are wanted, row by row there and back.
fn snake([width, height]: [u32; 2], cells: u32) -> impl Iterator<Item = [u32; 2]> {
    let side = libm::sqrt(f64::from(width) * f64::from(height) / f64::from(cells));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "smaller than a picture")]
    let side = (libm::round(side) as u32).max(1);
    let (columns, rows) = (width.div_ceil(side), height.div_ceil(side));
    (0..rows).flat_map(move |row| {
        (0..columns).flat_map(move |column| {
            let column = if row % 2 == 0 { column } else { columns - 1 - column };
            let of = move |cell: u32, pixels: u32| cell * side..((cell + 1) * side).min(pixels);
            of(row, height).flat_map(move |y| of(column, width).map(move |x| [x, y]))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn each_cell_has_one() {
        let pixels = Pixels::choose(&Preview::plain([200, 100]), 200, 1);
        assert_eq!(pixels.len(), 200);
        let cells: BTreeSet<[u32; 2]> = pixels.at.iter().map(|[x, y]| [x / 10, y / 10]).collect();
        assert_eq!(cells.len(), 200);
        let near = |two: &[[u32; 2]]| two[0][0].abs_diff(two[1][0]) <= 20 && two[0][1].abs_diff(two[1][1]) <= 20;
        assert!(pixels.at.windows(2).all(near));
        assert_ne!(pixels.at, Pixels::choose(&Preview::plain([200, 100]), 200, 2).at);
        assert!(pixels.stand_for.iter().all(|&weight| (weight - 1.0).abs() < 1e-9));
    }

    #[test]
    fn a_small_picture_is_taken_whole() {
        let all: BTreeSet<_> = Pixels::choose(&Preview::plain([7, 5]), 1000, 3).at.into_iter().collect();
        assert_eq!(all.len(), 35);
    }

    #[test]
    fn means_are_of_all_pixels_however_often_each_is_chosen() {
        // A column of edges, each a hundred times as far off as others, and twenty times as important.
        let value = |at: [u32; 2]| if at[0] == 30 { 100.0 } else { 1.0 };
        let importance = (0..10_000).map(|at| if at % 100 == 30 { 20.0 } else { 1.0 }).collect();
        let preview = Preview::given([100, 100], importance);
        let mean = |seed: u64| {
            let pixels = Pixels::choose(&preview, 100, seed);
            let of_all: f64 = pixels.at.iter().zip(&pixels.stand_for).map(|(&at, weight)| weight * value(at)).sum();
            of_all / pixels.len() as f64
        };
        let means: Vec<f64> = (0..200).map(mean).collect();
        let found = means.iter().sum::<f64>() / 200.0;
        assert!((found - 1.99).abs() < 0.03, "{found}");
        // Chosen alike, it would be 0.99 in one of a hundred and more: a spread of 1.
        let spread = means.iter().map(|mean| libm::pow(mean - found, 2.0)).sum::<f64>() / 199.0;
        assert!(spread < 0.09, "{spread}");
    }
}
