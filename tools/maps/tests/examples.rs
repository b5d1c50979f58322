//! Do the examples do what they say?

#[path = "../examples/ten_neighbours.rs"]
#[allow(dead_code, unreachable_pub)]
mod ten_neighbours;

#[test]
fn ten_neighbours_and_their_flux() {
    let ten_neighbours::Gathered { nearest, flux, reads } = ten_neighbours::gather().unwrap();
    // The point lies beside photon 50 of row 50, of 101 each; its neighbours are a hundredth away, and so on outwards.
    assert_eq!(nearest.len(), 10);
    assert_eq!(nearest[0].1, 50 * 101 + 50);
    assert!(nearest[0].0 < 0.003 && (0.008..0.013).contains(&nearest[4].0) && nearest[9].0 < 0.025, "{nearest:?}");
    assert!(nearest.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    // Ten of power 1.5, 1, 1, which are stored to a part in 256.
    assert!((flux[0] - 15.0).abs() < 0.2 && (flux[1] - 10.0).abs() < 0.1 && (flux[2] - 10.0).abs() < 0.1, "{flux:?}");
    // Splits and leaves, a few tens of 10,201 photons.
    assert!((3..60).contains(&reads), "{reads}");
}
