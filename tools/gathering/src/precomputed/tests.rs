//! Is precomputed irradiance the estimate at the sites, found as looking at every site finds it?

use super::build::CHUNK;
use super::*;
use crate::{Edges, EstimateOptions, Estimator, Kernel, RadianceEstimate, Scratch};
use bytemuck::Zeroable as _;
use pm_formats::trace::{Access, BlockEncoder, TraceReader, TraceSink, TraceWriter};
use pm_formats::{BlockMeta, Header};
use pm_maps::geometry::distance_squared;
use pm_maps::{Blind, BruteForce, Nearest, Search, SearchReads};
use pm_random::Random;
use std::f64::consts::PI;

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const NORMALS: [[f32; 3]; 4] = [UP, [0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.6, 0.8, 0.0]];

fn options(k: usize) -> EstimateOptions {
    EstimateOptions {
        k,
        max_dist: f32::INFINITY,
        estimator: Estimator::Unbiased,
        kernel: Kernel::Constant,
        edges: Edges::Cut,
    }
}

fn materials() -> Vec<Material> {
    let matt = Material { name: "m".into(), diffuse: [0.5, 0.25, 1.0], specular: [0.0; 3], exponent: 0.0 };
    vec![matt.clone(), Material { specular: [0.1; 3], exponent: 5.0, ..matt }]
}

fn photon(position: [f32; 3], normal: [f32; 3]) -> Photon {
    Photon::new(position, [1.0; 3], [0.5; 3], normal, normal).unwrap()
}

fn query(position: [f32; 3], normal: [f32; 3]) -> Query {
    let (normal, view) = Query::pack_vectors(normal, normal);
    Query { position, normal, view, weight: [1.0, 2.0, 1.0], ..Query::zeroed() }
}

/// Calls `test` with the sites of `photons` and what they were made from.
fn with_sites<T>(
    photons: &[Photon],
    search: Search,
    share: u32,
    test: impl for<'a> FnOnce(PrecomputedIrradiance<'a>, &Precomputation<'a>) -> T,
) -> T {
    let map = BruteForce::build(photons).unwrap();
    let materials = materials();
    let options = EstimateOptions { max_dist: search.max_dist, ..options(search.k) };
    let estimate = RadianceEstimate::new(photons, &materials, 1, options);
    let how =
        Precomputation { map: &map, search, reread: false, photons, estimate: &estimate, share, materials: &materials };
    test(PrecomputedIrradiance::new(&how, 1).unwrap(), &how)
}

/// Positions by name that break trees, each with a normal of its own.
fn cases() -> Vec<(&'static str, Vec<Photon>)> {
    let mut random = Random::new(&[11]);
    let mut points = |n: usize, map: fn([f32; 3]) -> [f32; 3]| -> Vec<[f32; 3]> {
        (0..n).map(|_| map([(); 3].map(|()| random.unit()))).collect()
    };
    let lattice = (0..1000u16).map(|i| [i % 10, i / 10 % 10, i / 100].map(f32::from)).collect();
    let all: Vec<(&'static str, Vec<[f32; 3]>)> = vec![
        ("none", vec![]),
        ("one", vec![[0.5; 3]]),
        ("seven", points(7, |p| p)),
        ("uniform", points(900, |p| p)),
        ("on a wall", points(500, |[x, _, z]| [x, 0.0, z])),
        ("on a line", points(300, |[x, _, _]| [0.3, x, 0.7])),
        ("two sites", (0..600u16).map(|i| [f32::from(i % 2); 3]).collect()),
        ("lattice with ties", lattice),
        ("offset 1e6", points(400, |p| p.map(|x| x + 1e6))),
        ("scale 1e-6", points(400, |p| p.map(|x| x * 1e-6))),
    ];
    let with_normals = |(name, positions): (&'static str, Vec<[f32; 3]>)| {
        // Not by the id alone, every fourth of which is a site.
        let normals = (0usize..).map(|i| NORMALS[i / 4 * 7 % 11 % 4]);
        (name, positions.into_iter().zip(normals).map(|(position, normal)| photon(position, normal)).collect())
    };
    all.into_iter().map(with_normals).collect()
}

#[test]
fn the_nearest_site_is_that_of_looking_at_all() {
    let mut found = 0;
    for (name, photons) in cases() {
        for max_dist in [0.0, 0.05, 1.0, f32::INFINITY] {
            for share in [1, 4, 1000] {
                with_sites(&photons, Search::new(5, max_dist), share, |sites, _| {
                    let own = photons.iter().step_by((photons.len() / 60).max(1)).map(|photon| photon.position);
                    let beside = own.clone().map(|[x, y, z]| [x + 0.013, y * 0.99, z - 0.4]);
                    for point in own.chain(beside).chain([[0.5; 3], [1e9, -1e9, 0.0]]) {
                        for normal in NORMALS.into_iter().chain([[0.0, 0.0, 1.0]]) {
                            let near = |at: &usize| distance_squared(point, sites.sites[*at].position);
                            let expected = (0..sites.sites.len())
                                .filter(|&at| {
                                    let own = photons[sites.ids[at] as usize].normal();
                                    (0..3).map(|axis| own[axis] * normal[axis]).sum::<f32>() > 0.9
                                })
                                .filter(|&at| {
                                    let Site { position, .. } = sites.sites[at];
                                    let reach = sites.sites[at].reach_squared();
                                    let off: f32 = (0..3).map(|i| (position[i] - point[i]) * normal[i]).sum();
                                    near(&at) <= reach && off * off <= reach / 64.0
                                })
                                .min_by(|a, b| near(a).total_cmp(&near(b)).then(sites.ids[*a].cmp(&sites.ids[*b])));
                            let nearest = sites.nearest(point, normal, &mut Blind);
                            assert_eq!(
                                nearest, expected,
                                "{name}, max {max_dist}, share {share}, {point:?} {normal:?}"
                            );
                            found += u32::from(nearest.is_some());
                        }
                    }
                });
            }
        }
    }
    assert!(found > 1000, "{found}");
}

#[test]
fn at_a_site_it_is_the_estimate() {
    let mut random = Random::new(&[12]);
    let floor: Vec<_> = (0..400).map(|_| photon([random.unit(), 0.0, random.unit()], UP)).collect();
    with_sites(&floor, Search::new(20, f32::INFINITY), 3, |sites, how| {
        assert_eq!(sites.sites.len(), 134);
        for (id, photon) in floor.iter().enumerate().step_by(3) {
            let query = query(photon.position, UP);
            let (mut found, mut scratch) = (Nearest::new(20, 0.0), Scratch::default());
            how.search.run(how.map, query.position, &mut found, &mut Blind);
            let Outcome::Radiance(expected) = how.estimate.contribution(&query, &found, &mut scratch) else { panic!() };
            let Some(Outcome::Radiance(found)) = sites.nearest_contribution(&query, &mut Blind) else { panic!() };
            // Photons are white, so that each mantissa is at least 128: off by at most one of them.
            let off = (0..3).map(|channel| (found[channel] / expected[channel] - 1.0).abs()).fold(0.0, f64::max);
            assert!(off < 1.0 / 128.0, "{id}: {found:?} for {expected:?}");
        }
    });
}

#[test]
fn an_even_density_is_seen_without_bias() {
    // Photons of flux 1 at 200 a unit area, looked up at points that know nothing of them. The discs must be large
    // beside the distances to the sites: the more photons to a site, the larger k. Would the photon at the site not count
    // they were 1/9 and 1/39 too dark.
    let mut random = Random::new(&[13]);
    for (share, k) in [(1, 10), (4, 40)] {
        let (runs, points) = (700u16, 10u16);
        let mut mean = 0.0;
        for _ in 0..runs {
            let floor: Vec<_> =
                (0..800).map(|_| photon([2.0 * random.unit() - 1.0, 0.0, 2.0 * random.unit() - 1.0], UP)).collect();
            with_sites(&floor, Search::new(k, f32::INFINITY), share, |sites, how| {
                for _ in 0..points {
                    let query = query([random.unit() - 0.5, 0.0, random.unit() - 0.5], UP);
                    // Where no site is near the query searches, as everybody's would.
                    let outcome = sites.nearest_contribution(&query, &mut Blind).unwrap_or_else(|| {
                        let (mut found, mut scratch) = (Nearest::new(k, 0.0), Scratch::default());
                        how.search.run(how.map, query.position, &mut found, &mut Blind);
                        how.estimate.contribution(&query, &found, &mut scratch)
                    });
                    let Outcome::Radiance([r, ..]) = outcome else { panic!() };
                    mean += r * PI / 0.5 / 200.0 / f64::from(runs * points);
                }
            });
        }
        // Standard error some 0.004: ten points of a run share many photons.
        assert!((mean - 1.0).abs() < 0.015, "one site in {share}, k = {k}: {mean}");
    }
}

#[test]
fn where_nothing_can_be_said_there_is_no_site() {
    // All photons at one point: no disc has an area.
    let spot = vec![photon([0.5; 3], UP); 100];
    with_sites(&spot, Search::new(10, f32::INFINITY), 4, |sites, _| {
        assert_eq!((sites.sites.len(), sites.searches, sites.built.no_area), (0, 25, 25));
        assert_eq!(sites.nearest_contribution(&query([0.5; 3], UP), &mut Blind), None);
    });
}

#[test]
fn a_site_counts_within_its_own_radius_near_the_plane_and_on_the_same_side() {
    // A row of photons 1 apart, whose middle ones have their tenth neighbour 5 away, and the last 9: of that 1/sqrt(2) counts.
    let row: Vec<_> = (0..101u8).map(|i| photon([f32::from(i), 0.0, 0.0], UP)).collect();
    with_sites(&row, Search::new(10, f32::INFINITY), 20, |sites, _| {
        assert_eq!(sites.sites.len(), 6);
        let answered = |at, normal| sites.nearest_contribution(&query(at, normal), &mut Blind).is_some();
        assert!(answered([43.5, 0.0, 0.0], UP) && !answered([43.6, 0.0, 0.0], UP));
        assert!(answered([106.2, 0.0, 0.0], UP) && !answered([106.5, 0.0, 0.0], UP));
        assert!(!answered([40.0, 0.0, 0.0], [1.0, 0.0, 0.0]) && !answered([40.0, 0.0, 0.0], [0.0, -1.0, 0.0]));
        // An eighth of the reach above the site, and lower.
        assert!(answered([40.0, 0.43, 0.0], UP) && !answered([40.0, 0.45, 0.0], UP));
    });
    with_sites(&row, Search::new(10, 2.0), 20, |sites, _| {
        let answered = |x| sites.nearest_contribution(&query([x, 0.0, 0.0], UP), &mut Blind).is_some();
        assert!(answered(41.4) && !answered(41.5), "a limit of the search is the radius of its disc");
    });
}

#[test]
fn a_site_does_not_count_beyond_the_edge_that_its_photons_show() {
    // A floor, and a wall that faces it, at x = 0; the floor goes on behind.
    let cell = |i: u16| [f32::from(i % 20) * 0.1 + 0.05, f32::from(i / 20) * 0.1];
    let floor = (0..400).map(|i| photon([cell(i)[0], 0.0, cell(i)[1]], UP));
    let wall = (0..400).map(|i| photon([0.0, cell(i)[0], cell(i)[1]], [1.0, 0.0, 0.0]));
    let photons: Vec<_> = floor.chain(wall).collect();
    with_sites(&photons, Search::new(60, f32::INFINITY), 1, |sites, _| {
        let answered = |x| sites.nearest_contribution(&query([x, 0.0, 1.0], UP), &mut Blind).is_some();
        assert!(answered(0.05) && answered(0.09) && answered(0.5));
        assert!(!answered(-0.01) && !answered(-0.2), "the room behind the wall");
    });
}

#[test]
fn threads_change_no_site() {
    let mut random = Random::new(&[14]);
    let floor: Vec<_> = (0..CHUNK as u32 * 5 / 2).map(|_| photon([random.unit(), 0.0, random.unit()], UP)).collect();
    with_sites(&floor, Search::new(5, f32::INFINITY), 1, |one, how| {
        let three = PrecomputedIrradiance::new(how, 3).unwrap();
        assert_eq!((one.sites, one.ids, one.built), (three.sites, three.ids, three.built));
    });
}

/// Remembers the reads of a trace: region and record.
#[derive(Default)]
struct Reads(Vec<(u16, u64)>);

impl TraceSink for Reads {
    fn access(&mut self, access: Access) {
        assert_eq!((access.len, access.offset % 20), (20, 0));
        self.0.push((access.region, access.offset / 20));
    }
}

#[test]
fn walks_come_back_from_a_trace() {
    for (name, photons) in cases() {
        with_sites(&photons, Search::new(5, f32::INFINITY), 4, |mut sites, how| {
            let regions = sites.lay_out(how.map.regions(false));
            let names: Vec<_> = regions.iter().map(|region| &*region.name).collect();
            assert_eq!(names, ["photons", "precomputed"], "there is a glossy material, whose queries read photons");
            let mut encoder = BlockEncoder::new(&regions);
            let mut expected = vec![];
            for (pixel, at) in (0..).zip(photons.iter().step_by(3)) {
                let mut reads = SearchReads::default();
                let _ = sites.nearest(at.position, UP, &mut reads);
                encoder.begin(&[pixel]);
                for (region, records) in reads.runs() {
                    encoder.records(region, records);
                    expected.extend(records.iter().map(|&record| (region, u64::from(record))));
                }
                encoder.end();
            }
            assert!(expected.iter().all(|&(region, _)| region == 1), "{name}");
            let header = Header { regions: regions.clone(), ..Header::empty() };
            let mut trace = TraceWriter::new(vec![], &header).unwrap();
            let (block, tally) = encoder.finish(BlockMeta::default()).unwrap();
            trace.write(&block, tally).unwrap();
            let bytes = trace.finish(vec![]).unwrap();
            let (mut reader, mut reads) = (TraceReader::new(&bytes[..]).unwrap(), Reads::default());
            while reader.replay_block(&mut reads).unwrap().is_some() {}
            assert_eq!(reads.0, expected, "{name}");
        });
    }
}

#[test]
fn glossy_surfaces_are_left_to_the_photon_map() {
    let floor: Vec<_> = (0..100u8).map(|i| photon([f32::from(i), 0.0, 0.0], UP)).collect();
    with_sites(&floor, Search::new(10, f32::INFINITY), 4, |mut sites, how| {
        assert!(sites.serves(&query([0.0; 3], UP)));
        assert!(!sites.serves(&Query { material: 1, ..query([0.0; 3], UP) }));
        // Glossy surfaces or not: where no site knows of a surface its queries read the photons.
        sites.materials = &how.materials[..1];
        let regions = sites.lay_out(how.map.regions(false));
        let names: Vec<_> = regions.iter().map(|region| (&*region.name, region.size)).collect();
        assert_eq!((names[1], sites.region), (("precomputed", 500), 1));
    });
}
