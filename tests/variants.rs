//! Is the picture the same for every order and number of threads, whichever way light is gathered?

use crate::support::{Folder, same_bytes};

/// A room of glossy walls.
const GLOSSY: &str = "mtllib glossy.mtl\n\
     v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 2 -1\nv 1 2 -1\nv -.3 1.9 -.3\nv .3 1.9 -.3\nv .3 1.9 .3\nv -.3 1.9 .3\n\
     usemtl floor\nf 1 2 3 4\nusemtl wall\nf 1 4 6 5\nusemtl lamp\nf 7 8 9 10\n";
const GLOSSY_MATERIALS: &str = "newmtl floor\nKd .4 .3 .2\nKs .3 .3 .4\nNs 20\nillum 2\n\
     newmtl wall\nKd .5 .5 .1\nKs .2 .2 .2\nNs 5\nillum 2\nnewmtl lamp\nKd 0 0 0\nKe 9 8 7\n";

/// Scene, options of `pm-queries`, options of `pm-gather`.
const VARIANTS: [[&str; 3]; 9] = [
    ["", "--samples 3", ""],
    ["", "--min-gather-dist auto", ""],
    ["", "", "--kernel epanechnikov"],
    ["", "", "--kernel cone"],
    ["", "", "--edges sloped"],
    ["glossy.obj --glossy --eye 0,1.2,3 --look-at 0,.8,0", "--samples 2", ""],
    ["", "--guide map.pmp", ""],
    ["glossy.obj --glossy --eye 0,1.2,3 --look-at 0,.8,0", "--guide map.pmp", "--kernel cone"],
    ["", "--guide map.pmp --min-gather-dist auto --samples 2 --no-caustics", "--estimator classic"],
];

#[test]
fn every_way_to_gather_gives_one_picture() {
    let folder = Folder::new();
    folder.write("glossy.mtl", GLOSSY_MATERIALS);
    folder.write("glossy.obj", GLOSSY);
    let mut all = vec![];
    for [scene, queries, gather] in VARIANTS {
        let photons = scene.split(" --eye").next().unwrap();
        folder.run(&format!("pm-photons {photons} -n 100000 -o map.pmp")).ok();
        let mut pictures = vec![];
        for (order, threads) in [
            ("", 1),
            ("", 2),
            ("--order tiled --tile 5", 1),
            ("--order tiled --tile 5", 2),
            ("| pm-reorder hilbert", 2),
            ("--order tiled | pm-reorder hilbert --per batch", 1),
            ("--strata shuffled | pm-reorder random", 1),
            ("| pm-reorder random --seed 3", 2),
        ] {
            let (order, reorder) = order.split_once('|').unwrap_or((order, ""));
            let reorder = if reorder.is_empty() { String::new() } else { format!("| {reorder}") };
            folder
                .sh(&format!(
                    "pm-queries -q {scene} --size 12x10 --gathers 4 --light-samples 2 {queries} {order} -t {threads} \
                     --base base.exr {reorder} | \
                     pm-gather map.pmp - -k 20 {gather} -t {threads} --no-trace --base base.exr --image x.exr"
                ))
                .ok();
            pictures.push(folder.read("x.exr"));
        }
        for picture in &pictures {
            same_bytes(&format!("`{scene}` `{queries}` `{gather}`"), &pictures[0], picture);
        }
        all.push(pictures.swap_remove(0));
    }
    // Each is a picture of its own: no option is without effect.
    for (i, picture) in all.iter().enumerate() {
        assert!(!all[..i].contains(picture), "{:?}", VARIANTS[i]);
    }
}
