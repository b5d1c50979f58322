//! Do photons with radii of their own give nearly the same light in one go each, and the same picture in any order?

use crate::furnace::radiance_is_the_known_one;
use crate::streams::{check, searches};
use crate::support::{Folder, SMALL, same_bytes};
use pm_formats::BlockReader;
use pm_pictures::{Comparison, Picture};

#[test]
fn in_a_furnace_the_radiance_is_the_known_one() {
    let options = [10, 100].map(|k| format!("-k {k} --photon-radii"));
    radiance_is_the_known_one(100_000, "--size 16x16 --gathers 36", options);
}

#[test]
fn the_light_is_nearly_that_of_the_nearest_for_fewer_reads() {
    let folder = Folder::new();
    folder.run("pm-photons -n 100000 -t 2 -o map.pmp").ok();
    folder.run("pm-queries --size 32x32 --gathers 36 --no-caustics -t 2 --base base.exr -o q.pmq").ok();
    let picture = |options: &str| {
        folder.run(&format!("pm-gather -q map.pmp q.pmq -t 2 --base base.exr {options} --image x.exr -o x.pmt")).ok();
        let trace = searches(&folder.read("x.pmt"));
        let reads = trace.iter().map(|search| search.accesses.len()).sum::<usize>();
        (Picture::decode_exr(&folder.read("x.exr")).unwrap(), reads)
    };
    let (full, all) = picture("");
    let (own, reads) = picture("--photon-radii");
    let apart = Comparison::new(&full, &own).unwrap();
    assert!(apart.ratio.iter().all(|ratio| (ratio - 1.0).abs() < 0.02) && apart.rel_mse < 0.001, "{apart:?}");
    assert!(reads < all / 4, "{reads} of {all}");
    // Photons that give half of what they have to the other side of an edge are not the same.
    let (ignored, _) = picture("--photon-radii --edges ignored");
    assert!(Comparison::new(&full, &ignored).unwrap().rel_mse > 1.5 * apart.rel_mse);
}

#[test]
fn the_picture_is_the_same_in_any_order_and_the_trace_holds_what_is_read() {
    let folder = Folder::with_streams();
    folder.run(&format!("pm-queries {SMALL} --base direct.exr -o q.pmq")).ok();
    folder.run("pm-reorder hilbert q.pmq -o hilbert.pmq").ok();
    folder.run("pm-reorder random q.pmq -o random.pmq").ok();
    let gather = |options: &str| {
        let line = format!("pm-gather -q map.pmp -k 40 --photon-radii {options} --base direct.exr");
        folder.run(&format!("{line} --image x.exr -o x.pmt")).ok();
        (folder.read("x.exr"), check(&folder.read("x.pmt")).unwrap().records)
    };
    let (picture, count) = gather("q.pmq");
    for options in ["hilbert.pmq", "random.pmq -t 3", "q.pmq -t 5", "q.pmq --start-radius 0.001", "q.pmq --map wide"] {
        let (other, searches) = gather(options);
        same_bytes(options, &picture, &other);
        assert_eq!(searches, count, "{options}");
    }
    for options in ["q.pmq --kernel cone", "q.pmq --edges ignored", "q.pmq --max-dist 0.02"] {
        assert!(gather(options).0 != picture, "{options} changes nothing");
    }
    gather("q.pmq");
    let trace = folder.read("x.pmt");
    let regions = BlockReader::new(&trace[..]).unwrap().header().regions.clone();
    let names: Vec<&str> = regions.iter().map(|region| &region.name[..]).collect();
    assert_eq!(names[names.len() - 2..], ["boxes", "discs"]);
    let boxes = u16::try_from(names.len() - 2).unwrap();
    // Each goes down from the root, once.
    for search in searches(&trace) {
        let first = search.accesses.first().expect("there is a root");
        assert_eq!((first.region, first.offset), (boxes, 0));
        let roots = search.accesses.iter().filter(|access| (access.region, access.offset) == (boxes, 0)).count();
        assert_eq!(roots, 1);
    }
    let text = folder.run("pm-view x.pmt").ok();
    for said in ["radii of photons, each of its own 40 nearest", "build_searches ", "lookups_without_site"] {
        assert!(text.text().contains(said), "{said}\n{}", text.text());
    }
}

#[test]
fn what_does_not_go_together_is_refused() {
    let folder = Folder::with_streams();
    for (options, said) in [
        ("--map brick", "holds irradiance itself"),
        ("--estimator classic", "leave --estimator out"),
        ("--edges sloped", "--edges cut or ignored"),
        ("-k 1", "-k 2 or more"),
        ("--precomputed-share 2", "--precomputed-share"),
    ] {
        let outcome = folder.run(&format!("pm-gather map.pmp q.pmq --photon-radii {options} -o t.pmt"));
        assert!(outcome.fails(2).contains(said), "{options}: {}", outcome.stderr);
    }
    for options in ["--precomputed", "--report r.csv", "--waits", "--carry"] {
        let outcome = folder.run(&format!("pm-gather map.pmp q.pmq --photon-radii {options} -o t.pmt"));
        assert!(outcome.code == 2 && outcome.stderr.contains("cannot be used with"), "{outcome:?}");
    }
}
