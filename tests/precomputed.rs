//! Does precomputed irradiance give nearly the same light for far fewer reads, and the same picture in any order?

use crate::furnace::radiance_is_the_known_one;
use crate::streams::{Search, check, records, searches};
use crate::support::{Folder, SMALL, same_bytes};
use pm_formats::{BlockReader, Query};
use pm_pictures::{Comparison, Picture};

fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn in_a_furnace_the_radiance_is_the_known_one() {
    let options = [50, 100].map(|k| format!("--precomputed -k {k}"));
    radiance_is_the_known_one(300_000, "--size 24x24 --gathers 64", options);
}

#[test]
fn the_light_is_that_of_the_full_estimate() {
    let folder = Folder::new();
    folder.run("pm-photons -n 100000 -t 2 -o map.pmp").ok();
    folder.run("pm-queries --size 48x48 --gathers 36 --no-caustics -t 2 --base base.exr -o q.pmq").ok();
    let gather = "pm-gather map.pmp q.pmq -t 2 --base base.exr";
    folder.run(&format!("{gather} --image full.exr -o full.pmt")).ok();
    let outcome = folder.run(&format!("{gather} --precomputed --image own.exr -o own.pmt"));
    assert!(outcome.fails(0).contains("queries searched all the same"), "{}", outcome.stderr);
    let [full, own] = ["full.exr", "own.exr"].map(|name| Picture::decode_exr(&folder.read(name)).unwrap());
    let apart = Comparison::new(&full, &own).unwrap();
    assert!(apart.ratio.iter().all(|ratio| (ratio - 1.0).abs() < 0.03), "{apart:?}");
    // No pixel is altogether another: leaks of light would show.
    assert!(apart.rel_mse < 0.001, "{apart:?}");
    let reads = |name: &str| searches(&folder.read(name)).iter().map(|search| search.accesses.len()).sum::<usize>();
    assert!(reads("own.pmt") < reads("full.pmt") / 6, "{} {}", reads("own.pmt"), reads("full.pmt"));
}

/// The reads of sites by each search, whatever the order of the searches.
fn site_reads(trace: &[u8]) -> Vec<(Vec<u32>, Vec<u64>)> {
    let region = BlockReader::new(trace).unwrap().header().regions.len() as u16 - 1;
    let sites = |search: Search| {
        let of_sites = search.accesses.iter().filter(|access| access.region == region);
        (search.pixels, of_sites.map(|access| access.offset).collect())
    };
    let mut reads: Vec<_> = searches(trace).into_iter().map(sites).collect();
    reads.sort();
    reads
}

#[test]
fn the_picture_and_the_searches_are_the_same_in_any_order() {
    let folder = Folder::with_streams();
    folder.run(&format!("pm-queries {SMALL} --base direct.exr -o q.pmq")).ok();
    folder.run(&format!("pm-queries {SMALL} --order tiled --tile 5 -o tiled.pmq")).ok();
    folder.run("pm-reorder hilbert q.pmq -o hilbert.pmq").ok();
    folder.run("pm-reorder random --per batch tiled.pmq -o random.pmq").ok();
    let gather = |options: &str| {
        let line = format!("pm-gather -q map.pmp -k 40 {options} --base direct.exr --image x.exr -o x.pmt");
        folder.run(&line).ok();
        let trace = folder.read("x.pmt");
        (folder.read("x.exr"), (check(&trace).unwrap().records, site_reads(&trace)))
    };
    let (picture, tally) = gather("q.pmq --precomputed");
    for options in [
        "tiled.pmq",
        "hilbert.pmq",
        "random.pmq -t 3",
        "q.pmq -t 5",
        "hilbert.pmq --map brute",
        "random.pmq --layout preorder --reread",
        "q.pmq --start-radius inf",
        "q.pmq --start-radius 0.001",
    ] {
        let (other, searches) = gather(&format!("{options} --precomputed"));
        same_bytes(options, &picture, &other);
        // Where the nodes of the map lie, or how it is searched, changes no read of a site.
        assert_eq!(searches, tally, "{options}");
    }
    assert!(gather("q.pmq").0 != picture);
    assert!(gather("q.pmq --precomputed --precomputed-share 3").0 != picture);
}

#[test]
fn cached_irradiance_takes_it_as_well() {
    let folder = Folder::new();
    folder.run("pm-photons -n 20000 -o map.pmp").ok();
    folder.run("pm-queries --size 20x16 --gathers 16 --irradiance-cache 0.2 --base base.exr -o q.pmq").ok();
    folder.run("pm-reorder random q.pmq -o r.pmq").ok();
    let picture = |options: &str| {
        folder.run(&format!("pm-gather -q map.pmp {options} --base base.exr --image x.exr --no-trace")).ok();
        folder.read("x.exr")
    };
    let own = picture("q.pmq --precomputed");
    same_bytes("in another order", &own, &picture("r.pmq --precomputed -t 3"));
    folder.write("own.exr", own);
    folder.write("full.exr", picture("q.pmq"));
    let [full, own] = ["full.exr", "own.exr"].map(|name| Picture::decode_exr(&folder.read(name)).unwrap());
    let apart = Comparison::new(&full, &own).unwrap();
    assert!(apart.differing > 0 && apart.ratio.iter().all(|ratio| (ratio - 1.0).abs() < 0.03), "{apart:?}");
}

#[test]
fn queries_of_glossy_surfaces_read_the_photon_map() {
    let folder = Folder::new();
    let text = |name: &str| std::fs::read_to_string(scene(name)).unwrap();
    let glossy = text("cornell-diffuse.mtl").replace("newmtl red\n", "newmtl red\nKs .3 .3 .3\nNs 20\n");
    folder.write("room.mtl", glossy.replace("illum 1", "illum 2"));
    folder.write("room.obj", text("cornell-diffuse.obj").replace("cornell-diffuse.mtl", "room.mtl"));
    folder.write("room.camera.toml", text("cornell-diffuse.camera.toml"));
    folder.run("pm-photons room.obj --glossy -n 5000 -o map.pmp").ok();
    folder.run("pm-queries room.obj --glossy --size 16x12 --gathers 9 --base base.exr -o q.pmq").ok();
    let queries = records::<Query>(&folder.read("q.pmq"));
    for options in ["", "--reread", "--reread --layout preorder", "--map brute"] {
        folder.run(&format!("pm-gather -q map.pmp q.pmq -k 20 --precomputed {options} -o t.pmt")).ok();
        let trace = folder.read("t.pmt");
        let header = BlockReader::new(&trace[..]).unwrap().header().clone();
        assert_eq!((header.regions.len(), &*header.regions[1].name), (2, "precomputed"));
        let searches = searches(&trace);
        assert_eq!(searches.len(), queries.len());
        let (mut by_region, mut searched_all_the_same) = ([0, 0], 0);
        for (search, query) in searches.iter().zip(&queries) {
            let diffuse = header.materials[usize::from(query.material)].specular == [0.0; 3];
            // A query of a diffuse surface reads sites, and then, where none knows of its surface, photons.
            let sites = search.accesses.iter().take_while(|access| access.region == 1).count();
            let photons = search.accesses.len() - sites;
            assert!(search.accesses[sites..].iter().all(|access| access.region == 0), "{options}");
            assert_eq!(sites > 0, diffuse, "{options}");
            searched_all_the_same += usize::from(diffuse && photons > 0);
            by_region[0] += photons;
            by_region[1] += sites;
        }
        assert!(by_region[0] > 0 && by_region[1] > 0, "{by_region:?}");
        let all = folder.run("pm-view t.pmt").ok().text().replace(',', "");
        let said = format!("lookups_without_site {searched_all_the_same}\n");
        assert!(all.contains(&said) && searched_all_the_same < queries.len() / 5, "{searched_all_the_same}\n{all}");
        // What is said of the reads is what stands in the trace.
        let accesses = format!("accesses {}\n", by_region[0] + by_region[1]);
        assert!(folder.run("pm-view t.pmt").ok().text().replace(',', "").contains(&format!("pm-gather    {accesses}")));
    }
}

#[test]
fn what_was_done_beforehand_is_reported() {
    let folder = Folder::with_streams();
    let photons = records::<pm_formats::Photon>(&folder.read("map.pmp")).len();
    folder.run("pm-gather -q map.pmp q.pmq --precomputed --precomputed-share 3 --start-radius inf -o t.pmt").ok();
    let text = folder.run("pm-view t.pmt").ok().text().replace(',', "");
    let number = |name: &str| -> usize {
        let line = text.lines().find_map(|line| line.strip_prefix(&format!("pm-gather    {name} ")));
        line.unwrap_or_else(|| panic!("no {name} in\n{text}")).parse().unwrap()
    };
    let sites = photons.div_ceil(3);
    for name in ["build_searches", "build_attempts", "precomputed_sites"] {
        assert_eq!(number(name), sites, "{name}");
    }
    assert_eq!(number("build_searches_without_area"), 0);
    assert!(number("build_accesses") > 100 * sites && number("lookups_without_site") < number("queries") / 10);
    let bytes = format!(" ({} bytes)\n", sites * 20);
    assert!(text.contains("\npm-gather    precomputed_bytes ") && text.contains(&bytes), "{text}");
    assert!(text.contains("\nregion       precomputed: 0x") && text.contains("irradiance at 1 of 3 photons\n"));
    // Without it nothing is said of it.
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    let text = folder.run("pm-view t.pmt").ok();
    assert!(!text.text().contains("precomputed") && !text.text().contains("build_"), "{}", text.text());
}

#[test]
fn where_no_site_knows_of_the_surface_the_query_searches_and_that_is_said() {
    let folder = Folder::new();
    folder.write(
        "photons.csv",
        "x,y,z,power_r,power_g,power_b,n_x,n_y,n_z\n".to_owned() + &"0,0,0,1,1,1,0,1,0\n".repeat(9),
    );
    folder.write("queries.csv", "x,y,z,n_x,n_y,n_z,pixel\n0,1,0,0,1,0,0\n0,1,0,1,0,0,1\n");
    folder.run("pm-view --import photons photons.csv -o map.pmp");
    folder.run("pm-view --import queries queries.csv --size 2x1 -o q.pmq");
    let outcome = folder.run("pm-gather map.pmp q.pmq -k 3 --precomputed --image x.exr -o t.pmt");
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("2 of 2 queries searched all the same"), "{}", outcome.stderr);
    // As if there were no sites.
    folder.run("pm-gather -q map.pmp q.pmq -k 3 --image plain.exr --no-trace").ok();
    let [found, plain] = ["x.exr", "plain.exr"].map(|name| Picture::decode_exr(&folder.read(name)).unwrap());
    assert!(found == plain && found != Picture::black([2, 1]), "{found:?}");
    let text = folder.run("pm-view t.pmt").ok();
    for said in ["precomputed_sites 0", "build_searches 3", "build_searches_without_area 3", "lookups_without_site 2"] {
        assert!(text.text().contains(said), "{said}\n{}", text.text());
    }
    folder.run("pm-cachesim t.pmt").ok();
}
