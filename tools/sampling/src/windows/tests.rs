//! Is every part of a stream as likely to be chosen as any other?

use super::*;

/// The 0.9999 quantile of chi-square by Wilson and Hilferty, PNAS 17, 1931.
fn chi_square_limit(freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    freedom * (1.0 - spread + 3.719 * spread.sqrt()).powi(3)
}

#[test]
fn every_stratum_gives_one_of_its_own_cells() {
    for (cells, strata) in [(1, 1), (7, 7), (100, 10), (103, 10), (u64::MAX, 3), (1000, 999)] {
        let choice = StratifiedCells::new(cells, strata, 5).unwrap();
        let chosen: Vec<u64> = choice.cells().collect();
        assert_eq!(chosen.len() as u64, strata);
        assert!(chosen.is_sorted_by(|a, b| a < b) && chosen.iter().all(|&cell| cell < cells));
        for (stratum, cell) in (0u128..).zip(chosen) {
            // Its middle, scaled to the strata, lies in this one: the k-th begins at the floor of k cells / strata.
            let first = stratum * u128::from(cells) / u128::from(strata);
            let next = (stratum + 1) * u128::from(cells) / u128::from(strata);
            assert!((first..next).contains(&u128::from(cell)), "{cell} of stratum {stratum}");
            let size = next - first;
            assert!(size.abs_diff(u128::from(cells / strata)) <= 1, "{size}");
        }
    }
    assert!(
        StratifiedCells::new(4, 5, 0).is_none()
            && StratifiedCells::new(4, 0, 0).is_none()
            && StratifiedCells::new(0, 0, 0).is_none()
    );
}

#[test]
fn every_cell_has_its_chance() {
    // Ten strata of 10 or 11 cells, and each cell of a stratum as often as the others.
    let seeds = 20_000u32;
    let (cells, strata) = (103u64, 10u64);
    let mut often = vec![0u32; cells as usize];
    for seed in 0..u64::from(seeds) {
        StratifiedCells::new(cells, strata, seed).unwrap().cells().for_each(|cell| often[cell as usize] += 1);
    }
    let mut chi_square = 0.0;
    for stratum in 0..strata {
        let cells = (stratum * cells / strata) as usize..((stratum + 1) * cells / strata) as usize;
        let expected = f64::from(seeds) / cells.len() as f64;
        chi_square += often[cells].iter().map(|&n| (f64::from(n) - expected).powi(2) / expected).sum::<f64>();
    }
    let limit = chi_square_limit((cells - strata) as f64);
    assert!(chi_square < limit, "{chi_square} is beyond {limit}");
}

#[test]
fn strata_and_seeds_are_chosen_for_by_themselves() {
    // How often two neighbouring strata, and two neighbouring seeds, have each pair of cells.
    let (cells, rounds) = (8u64, 20_000u64);
    let mut pairs = [vec![0u32; 64], vec![0u32; 64]];
    for seed in 0..rounds {
        let at = |seed, stratum| chosen(seed, stratum, cells);
        pairs[0][(at(seed, 3) * cells + at(seed, 4)) as usize] += 1;
        pairs[1][(at(seed, 3) * cells + at(seed + 1, 3)) as usize] += 1;
    }
    for pairs in pairs {
        let expected = rounds as f64 / 64.0;
        let chi_square = pairs.iter().map(|&n| (f64::from(n) - expected).powi(2) / expected).sum::<f64>();
        assert!(chi_square < chi_square_limit(63.0), "{chi_square}");
    }
}

#[test]
fn every_record_has_the_same_chance_up_to_the_last() {
    // Strata of 12 in cells of 3; the stream ends after 31 records, in the middle of a cell of the third stratum.
    let (records, seeds) = (31u64, 40_000u32);
    let mut often = vec![0u32; records as usize];
    for seed in 0..u64::from(seeds) {
        let every = StratifiedStream::new(12, 3, seed).unwrap();
        for stratum in 0..records.div_ceil(12) {
            let window = every.window(stratum);
            assert!(window.start >= stratum * 12 && window.end <= (stratum + 1) * 12);
            window.take_while(|&at| at < records).for_each(|at| often[at as usize] += 1);
        }
    }
    // A quarter each; 5 standard errors.
    for n in often {
        assert!((f64::from(n) / f64::from(seeds) - 0.25).abs() < 5.0 * (0.25 * 0.75 / f64::from(seeds)).sqrt());
    }
    assert!(
        StratifiedStream::new(10, 3, 0).is_none()
            && StratifiedStream::new(2, 3, 0).is_none()
            && StratifiedStream::new(0, 0, 0).is_none()
    );
    assert_eq!(StratifiedStream::new(u64::MAX, 1, 0).unwrap().window(9).end, u64::MAX);
}

#[test]
fn the_last_cell_may_be_short() {
    let cells: Vec<_> = (0..4).map(|cell| cell_of(cell, 3, 10)).collect();
    assert_eq!(cells, [0..3, 3..6, 6..9, 9..10]);
}
