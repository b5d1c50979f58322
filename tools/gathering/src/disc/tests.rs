//! Are areas and integrals of a cut disc what they are by hand and by random points?

use super::*;
use crate::surface::Spot;
use pm_random::Random;
use std::f64::consts::PI;

/// A disc of radius 1 about the origin, cut by these strangers.
fn cut(disc: &mut Disc, strangers: &[Stranger]) {
    let surface = Surface { position: DVec3::ZERO, normal: [0.0, 1.0, 0.0], radius: 1.0 };
    let (places, distances): (Vec<u32>, Vec<f32>) = (0..).zip(strangers.iter().map(|one| one.rank.0)).unzip();
    let mut around = Around::default();
    let spot = |place: u32| Spot { position: strangers[place as usize].offset.as_vec3().to_array(), code: 0 };
    around.add(&places, &distances, spot, |_| false);
    disc.cut(&surface, &mut around, |_, number| strangers[number as usize]);
}

/// Is a point on the query's side of every cut?
fn holds(disc: &Disc, offset: DVec3) -> bool {
    disc.cuts.iter().all(|cut| cut.depth(offset) >= 0.0)
}

/// A disc in the plane y = 0, cut by vertical planes at these distances and angles (degrees).
fn disc(cuts: &[(f64, f64)]) -> Disc {
    let mut disc = Disc::new(DVec3::Y);
    let strangers: Vec<_> = (0..)
        .zip(cuts)
        .map(|(id, &(distance, degrees))| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let towards = DVec3::new(cos, 0.0, sin);
            // Not beyond the cuts before it.
            let aside = DVec3::new(-sin, 1.0, cos);
            let rank = (distance as f32, id);
            Stranger { rank, offset: towards * distance + aside * 0.2, normal: -towards }
        })
        .collect();
    cut(&mut disc, &strangers);
    assert_eq!(disc.cuts.len(), cuts.len());
    disc
}

#[test]
fn a_segment_has_the_area_of_a_segment() {
    for d in [0.0, 0.1, 0.5, 0.99] {
        let segment = f64::acos(d) - d * f64::sqrt(1.0 - d * d);
        let area = disc(&[(d, 77.0)]).integral(Kernel::Constant);
        assert!((area - (PI - segment)).abs() < 1e-9, "{d}: {area}");
    }
    // A quarter, and a square.
    assert!((disc(&[(0.0, 0.0), (0.0, 90.0)]).integral(Kernel::Constant) - PI / 4.0).abs() < 1e-9);
    let square: Vec<_> = [0.0, 90.0, 180.0, 270.0].map(|angle| (0.6, angle)).into();
    assert!((disc(&square).integral(Kernel::Constant) - 1.44).abs() < 1e-9);
}

#[test]
fn integrals_are_those_of_random_points() {
    let cuts: [&[(f64, f64)]; 5] = [
        &[],
        &[(0.3, 10.0)],
        &[(0.3, 10.0), (0.4, 100.0)],
        &[(0.2, -50.0), (0.35, 30.0), (0.6, 170.0)],
        &[(0.1, 0.0), (0.2, 80.0), (0.3, 160.0), (0.4, 240.0)],
    ];
    for (cuts, kernel) in
        cuts.iter().flat_map(|cuts| [Kernel::Constant, Kernel::Cone, Kernel::Epanechnikov].map(|k| (cuts, k)))
    {
        let disc = disc(cuts);
        let mut random = Random::new(&[3]);
        let n = 200_000;
        let mut sum = 0.0;
        for _ in 0..n {
            let (x, z) = (f64::from(random.unit()) * 2.0 - 1.0, f64::from(random.unit()) * 2.0 - 1.0);
            let s = x.hypot(z);
            if s < 1.0 && holds(&disc, DVec3::new(x, 0.0, z)) {
                sum += 4.0 * kernel.weight(s) / f64::from(n);
            }
        }
        let integral = disc.integral(kernel);
        // Standard error at most 2 / sqrt(n) = 0.0045.
        assert!((integral - sum).abs() < 0.015, "{cuts:?} {kernel:?}: {integral} for {sum}");
    }
}

#[test]
fn only_what_reaches_the_disc_from_another_side_cuts_it() {
    let cut = |offset: DVec3, normal: DVec3| {
        let mut disc = Disc::new(DVec3::Y);
        cut(&mut disc, &[Stranger { rank: (0.0, 0), offset, normal }]);
        !disc.cuts.is_empty()
    };
    assert!(cut(DVec3::new(0.5, 0.3, 0.0), DVec3::NEG_X));
    // A convex edge: the other surface looks away.
    assert!(cut(DVec3::new(0.5, -0.3, 0.0), DVec3::X));
    // The back of a thin wall; a wall whose plane passes by.
    assert!(!cut(DVec3::new(0.5, -0.01, 0.0), DVec3::NEG_Y));
    assert!(!cut(DVec3::new(0.7, 0.7, 0.0), DVec3::new(-0.8, -0.6, 0.0)));
}

/// Sum of f over a fine grid of points of the disc, each times the kernel's weight and its area.
fn over(disc: &Disc, kernel: Kernel, f: impl Fn(DVec3) -> f64) -> f64 {
    let n = 1000;
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0;
    let points = (0..n * n).map(|i| DVec3::new(at(i % n), 0.0, at(i / n)));
    let inside = points.filter(|p| p.length() < 1.0 && holds(disc, *p));
    inside.map(|p| kernel.weight(p.length()) * f(p)).sum::<f64>() * 4.0 / f64::from(n * n)
}

#[test]
fn weights_by_slope_find_light_that_slopes_as_it_is_in_the_middle() {
    let cuts: [&[(f64, f64)]; 5] = [
        &[(0.0, 77.0)],
        &[(0.3, 10.0)],
        &[(0.0, 10.0), (0.1, 100.0)],
        &[(0.2, -50.0), (0.35, 30.0), (0.6, 170.0)],
        &[(0.1, 0.0), (0.2, 80.0), (0.3, 160.0), (0.4, 240.0)],
    ];
    for cuts in cuts {
        for kernel in [Kernel::Constant, Kernel::Cone, Kernel::Epanechnikov] {
            let disc = disc(cuts);
            let slope = Slope::of(&disc, kernel).expect("a disc that is cut");
            let area = disc.integral(kernel);
            // What even light, and such as is 1 in the middle and slopes to 0 and 2 at the rim, is found to be.
            for gradient in [DVec3::ZERO, DVec3::X, DVec3::Z, DVec3::new(-0.6, 0.0, 0.8)] {
                let found = over(&disc, kernel, |p| slope.weight(p) * (1.0 + gradient.dot(p))) / area;
                assert!((found - 1.0).abs() < 0.006, "{cuts:?} {kernel:?} {gradient}: {found}");
            }
        }
    }
    // At a straight edge all alike would be 4/(3 pi) off.
    let half = disc(&[(0.0, 0.0)]);
    let alike = over(&half, Kernel::Constant, |p| 1.0 - p.x) / half.integral(Kernel::Constant);
    assert!((alike - 1.0 - 4.0 / (3.0 * PI)).abs() < 0.003, "{alike}");
    assert!(Slope::of(&disc(&[]), Kernel::Constant).is_none());
}

#[test]
fn one_cut_is_no_special_case() {
    let mut random = Random::new(&[12]);
    let some = (0..2000).map(|_| f64::from(random.unit()));
    for distance in some.chain([0.0, 1e-10, 1e-6, 1.0 - 1e-6, 1.0 - 1e-12]) {
        let mut disc = Disc::new(DVec3::Y);
        disc.cuts.push(Cut { normal: DVec3::NEG_X, height: distance, distance, angle: 0.0, towards: DVec3::X });
        for kernel in [Kernel::Constant, Kernel::Cone, Kernel::Epanechnikov] {
            let mut sum = 0.0;
            disc.sectors(|from, to, border| sum += sector(kernel, from, to, border));
            assert_eq!(disc.integral(kernel).to_bits(), f64::to_bits(sum), "{distance} {kernel:?}");
        }
    }
}

#[test]
fn cuts_take_away_the_very_photons_that_doubles_say_are_beyond() {
    let mut random = Random::new(&[13]);
    let mut unit = || random.unit();
    for round in 0..600 {
        let radius = [1e-21, 1e-6, 0.03, 1.0, 7e5, 1e17][round % 6];
        let scale = if round % 12 < 6 { 0.0 } else { radius };
        let position = [(); 3].map(|()| (unit() - 0.5) * scale);
        let surface = Surface {
            position: glam::Vec3::from(position).as_dvec3(),
            normal: [0.0, 1.0, 0.0],
            radius: f64::from(radius),
        };
        let count = 1 + (unit() * 150.0) as u32;
        let normal = glam::Vec3::new(unit() - 0.5, 0.2 * (unit() - 0.5), unit() - 0.5).normalize().as_dvec3();
        let cut = Cut { normal, height: f64::from(unit()) * 0.9, distance: 0.5, angle: 0.0, towards: -normal };
        // Every other one about the plane or as far inside as strangers count as of it, and some exactly there.
        let spots: Vec<Spot> = (0..count)
            .map(|number| {
                let mut offset = DVec3::from([(); 3].map(|()| f64::from(unit()) * 1.1 - 0.55));
                if number % 2 == 1 {
                    let depth = [0.0, ON_THE_PLANE][(number / 2 % 2) as usize]
                        + f64::from(unit() - 0.5) * [0.0, 1e-7, 1e-4][number as usize % 3];
                    offset += normal * (depth - cut.depth(offset));
                }
                let position = (surface.position + offset * surface.radius).as_vec3().to_array();
                Spot { position, code: u32::from(unit() < 0.4) }
            })
            .collect();
        let mut around = Around::default();
        // In two pieces, as maps with a heap tell of them.
        let (places, distances): (Vec<u32>, Vec<f32>) = (0..count).map(|place| (place, place as f32)).unzip();
        let first = places.len() / 3;
        for range in [0..first, first..places.len()] {
            around.add(&places[range.clone()], &distances[range], |place| spots[place as usize], |code| code == 0);
        }
        let is = |place: &u32, own: bool| (spots[*place as usize].code == 0) == own;
        let depth = |place: &u32| cut.depth(surface.offset(spots[*place as usize].position));
        let strangers = |around: &Around| around.strangers().to_vec();
        assert_eq!(strangers(&around), places.iter().copied().filter(|place| is(place, false)).collect::<Vec<_>>());
        around.take_away(&surface, &cut);
        let left = places.iter().copied().filter(|place| is(place, false) && depth(place) > ON_THE_PLANE);
        assert_eq!(strangers(&around), left.collect::<Vec<_>>(), "{radius}");
        for (with_cut_off, rim) in [(false, None), (true, None), (false, Some(count / 2))] {
            let mut own = vec![];
            around.own(with_cut_off, rim, &mut own);
            let inside = |place: &u32| with_cut_off || depth(place) >= 0.0;
            let kept = places.iter().filter(|place| is(place, true) && inside(place) && Some(**place) != rim);
            assert_eq!(own, kept.map(|&place| (place, place as f32)).collect::<Vec<_>>(), "{radius}");
        }
    }
}
