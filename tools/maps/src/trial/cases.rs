//! Photons that break maps, and where to search among them.

use pm_formats::Photon;
use pm_random::Random;

/// Photons at these positions.
///
/// # Panics
/// If there are more than 2^30.
#[must_use]
pub fn photons(positions: impl IntoIterator<Item = [f32; 3]>) -> Vec<Photon> {
    let up = [0.0, 1.0, 0.0];
    let photon = |p| Photon::new(p, [1.0; 3], [0.5; 3], up, up).expect("a plain photon");
    positions.into_iter().map(photon).collect()
}

/// So many points of the unit cube, each mapped to somewhere else.
pub fn random_points(n: usize, mut map: impl FnMut([f32; 3]) -> [f32; 3]) -> Vec<[f32; 3]> {
    let mut random = Random::new(&[n as u64]);
    (0..n).map(|_| map([(); 3].map(|()| random.unit()))).collect()
}

/// Positions by name: what each is like.
#[must_use]
pub fn cases() -> Vec<(&'static str, Vec<[f32; 3]>)> {
    let lattice = (0..1000u16).map(|i| [i % 10, i / 10 % 10, i / 100].map(f32::from)).collect();
    let clusters = random_points(900, |[x, y, z]| [(x * 3.0).floor() + y * 1e-4, (y * 2.0).floor(), z * 1e-3]);
    let half = random_points(600, |p| if p[0] < 0.5 { [0.25; 3] } else { p });
    vec![
        ("none", vec![]),
        ("one", vec![[0.5; 3]]),
        ("two", vec![[0.0; 3], [1.0; 3]]),
        ("15", random_points(15, |p| p)),
        ("16", random_points(16, |p| p)),
        ("17", random_points(17, |p| p)),
        ("99", random_points(99, |p| p)),
        ("257", random_points(257, |p| p)),
        ("uniform", random_points(2000, |p| p)),
        ("on a wall", random_points(1500, |[x, _, z]| [x, 0.0, z])),
        ("on a line", random_points(500, |[x, _, _]| [0.3, x, 0.7])),
        ("sorted line", (0..500u16).map(|i| [f32::from(i), 0.0, 0.0]).collect()),
        ("identical", vec![[0.1, 0.2, 0.3]; 1000]),
        ("two sites", (0..1000).map(|i| if i % 2 == 0 { [0.0; 3] } else { [1.0; 3] }).collect()),
        ("half in one spot", half),
        ("lattice with ties", lattice),
        ("clusters", clusters),
        ("offset 1e6", random_points(700, |p| p.map(|x| x + 1e6))),
        ("scale 1e-6", random_points(700, |p| p.map(|x| x * 1e-6))),
        ("denormal", random_points(300, |p| p.map(|x| x * 1e-40))),
        ("huge", random_points(300, |p| p.map(|x| (x - 0.5) * 1e18))),
        ("signed zeros", (0..200).map(|i| if i % 2 == 0 { [0.0; 3] } else { [-0.0; 3] }).collect()),
        ("needle", random_points(500, |[x, y, z]| [x * 1e6, y * 1e-6, z * 1e-6])),
    ]
}

/// Where to search: at photons, beside them, and far away.
#[must_use]
pub fn query_points(positions: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let at = positions.iter().step_by((positions.len() / 20).max(1)).copied();
    let beside = random_points(20, |p| {
        let near = positions.get((p[0] * positions.len() as f32) as usize).copied().unwrap_or([0.0; 3]);
        [near[0] + (p[1] - 0.5) * 0.1, near[1] + (p[2] - 0.5) * 0.1, near[2]]
    });
    at.chain(beside).chain([[1e9, -1e9, 0.0], [0.0; 3]]).collect()
}
