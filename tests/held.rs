//! Does irradiance held in bricks or hashed cells give nearly the same light for far fewer reads, and the same picture in any order?

use crate::furnace::radiance_is_the_known_one;
use crate::streams::{check, searches};
use crate::support::{Folder, SMALL, same_bytes};
use pm_formats::BlockReader;
use pm_pictures::{Comparison, Picture};

fn words() -> Vec<&'static str> {
    pm_gathering::irradiance_structures().words()
}

#[test]
fn in_a_furnace_the_radiance_is_the_known_one() {
    let options = words().into_iter().map(|word| format!("--map {word}"));
    radiance_is_the_known_one(100_000, "--size 16x16 --gathers 36", options);
}

#[test]
fn the_light_is_nearly_that_of_the_full_estimate_and_a_narrow_footprint_is_nearer() {
    let folder = Folder::new();
    folder.run("pm-photons -n 100000 -t 2 -o map.pmp").ok();
    folder.run("pm-queries --size 32x32 --gathers 36 --no-caustics -t 2 --base base.exr -o q.pmq").ok();
    let picture = |options: &str| {
        folder.run(&format!("pm-gather -q map.pmp q.pmq -t 2 --base base.exr {options} --image x.exr -o x.pmt")).ok();
        Picture::decode_exr(&folder.read("x.exr")).unwrap()
    };
    let reads = || searches(&folder.read("x.pmt")).iter().map(|search| search.accesses.len()).sum::<usize>();
    let full = picture("");
    let all = reads();
    for word in words() {
        let apart = |options: &str| Comparison::new(&full, &picture(&format!("--map {word} {options}"))).unwrap();
        let own = apart("");
        assert!(own.ratio.iter().all(|ratio| (ratio - 1.0).abs() < 0.01) && own.rel_mse < 0.002, "{word}: {own:?}");
        assert!(reads() < all / 10, "{word}: {} of {all}", reads());
        let narrow = apart("--footprint 0.01");
        assert!(narrow.rel_mse < own.rel_mse, "{word}: {narrow:?}, {own:?}");
    }
}

#[test]
fn the_picture_is_the_same_in_any_order_and_the_trace_holds_what_is_read() {
    let folder = Folder::with_streams();
    folder.run(&format!("pm-queries {SMALL} --base direct.exr -o q.pmq")).ok();
    folder.run("pm-reorder hilbert q.pmq -o hilbert.pmq").ok();
    folder.run("pm-reorder random q.pmq -o random.pmq").ok();
    for word in words() {
        let gather = |options: &str| {
            let line =
                format!("pm-gather -q map.pmp -k 40 --map {word} {options} --base direct.exr --image x.exr -o x.pmt");
            folder.run(&line).ok();
            let trace = folder.read("x.pmt");
            (folder.read("x.exr"), check(&trace).unwrap().records)
        };
        let (picture, count) = gather("q.pmq");
        for options in ["hilbert.pmq", "random.pmq -t 3", "q.pmq -t 5", "q.pmq --start-radius 0.001", "q.pmq --carry"] {
            let (other, searches) = gather(options);
            same_bytes(&format!("{word} {options}"), &picture, &other);
            assert_eq!(searches, count, "{word} {options}");
        }
        assert!(gather("q.pmq --precomputed-share 3").0 != picture && gather("q.pmq --footprint 0.02").0 != picture);
        let trace = folder.read("x.pmt");
        let header = BlockReader::new(&trace[..]).unwrap().header().clone();
        let held =
            searches(&trace).iter().filter(|search| search.accesses.iter().any(|access| access.region > 0)).count();
        assert!(header.regions.len() > 1 && held > 0, "{word}: {:?}", header.regions);
        let text = folder.run("pm-view x.pmt").ok();
        for said in
            ["precomputed  irradiance at 1 of 4 photons, in ", "at most 0.02 wide", "build_searches ", "map          "]
        {
            assert!(text.text().contains(said), "{word}: {said}\n{}", text.text());
        }
    }
}

#[test]
fn what_does_not_go_together_is_refused() {
    let folder = Folder::with_streams();
    for word in words() {
        for (options, said) in [
            ("--precomputed", "leave out one of them"),
            ("--report r.csv", "looks irradiance up"),
            ("--waits", "do not tell what their reads wait for"),
            ("--layout veb", "--map kd"),
        ] {
            let outcome = folder.run(&format!("pm-gather map.pmp q.pmq --map {word} {options} -o t.pmt"));
            assert!(outcome.fails(2).contains(said), "{word} {options}: {}", outcome.stderr);
        }
    }
    let outcome = folder.run("pm-gather map.pmp q.pmq --map kd --footprint 0.1 -o t.pmt");
    assert!(outcome.fails(2).contains("--footprint is for --map brick, cell-cache"), "{}", outcome.stderr);
}
