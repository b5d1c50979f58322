//! Are cells as many as asked, and is what has no room counted?

use super::build::cubes;
use super::*;

fn photons(positions: impl IntoIterator<Item = [f32; 3]>) -> Vec<Photon> {
    let up = [0.0, 1.0, 0.0];
    positions.into_iter().map(|p| Photon::new(p, [1.0; 3], [0.5; 3], up, up).unwrap()).collect()
}

#[test]
fn cubes_are_as_many_as_asked_or_a_little_fewer() {
    for extents in [[1.0; 3], [1.0, 1.0, 0.0], [1e6, 0.0, 0.0], [1e6, 1e-6, 1e-6], [1e-40; 3], [3.0, 2.0, 0.5]] {
        for most in [1, 2, 10, 1000, 100_000] {
            let (side, [x, y, z]) = cubes(extents, most);
            assert!(x * y * z <= most && x * y * z * 30 >= most, "{extents:?} {most}: {side} {x} {y} {z}");
        }
    }
}

#[test]
fn fixed_cells_lose_what_has_no_room_and_say_so() {
    // A hundred photons in one spot, and one far away so that there are cells.
    let list = photons((0..100).map(|_| [0.0; 3]).chain([[1.0; 3]]));
    let grid = Grid::build(&list, Cells::Fixed { line: 128, slots: Some(6) }).unwrap();
    assert_eq!((grid.lost(), grid.points.len(), grid.is_exact()), (94, 7, false));
    let roomy = Grid::build(&list, Cells::Fixed { line: 128, slots: Some(100) }).unwrap();
    assert_eq!((roomy.lost(), roomy.is_exact()), (0, true));
    let mut found = Nearest::new(101, f32::INFINITY);
    grid.nearest([0.0; 3], &mut found, &mut crate::Blind);
    assert_eq!(found.len(), 7);
}

#[test]
fn a_fixed_cell_is_read_as_far_as_it_is_used() {
    let grid = Grid::build(&photons([[0.0; 3]; 3]), Cells::Fixed { line: 32, slots: Some(9) }).unwrap();
    // 8 + 9 x 20 bytes are six lines; 8 + 3 x 20 bytes reach into the third.
    assert_eq!(grid.regions(false)[0].size, 192);
    let mut reads = 0u64;
    grid.nearest([0.0; 3], &mut Nearest::new(1, f32::INFINITY), &mut reads);
    assert_eq!(reads, 3);
}
