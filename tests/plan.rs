//! `pm-plan`: does what it prints make the picture it promises, and does it refuse what it cannot promise?

use crate::support::Folder;

/// Little work, for small pictures.
const LITTLE: &str = "--pixels 144 --pilot-photons 20000";

/// The error of a picture as pm-plan means it: the root of relMSE.
fn error(folder: &Folder, reference: &str, picture: &str) -> f64 {
    let printed = folder.run(&format!("pm-view -q {reference} {picture} --format csv")).ok();
    let lines: Vec<Vec<&str>> = printed.text().lines().map(|line| line.split(',').collect()).collect();
    let column = lines[0].iter().position(|name| *name == "rel_mse").expect("a column");
    lines[1][column].parse::<f64>().expect("a number").sqrt()
}

#[test]
fn what_is_pasted_has_the_error_that_was_wanted() {
    // Catches: options that are printed and not those that were tried, an error of another definition than pm-view's, noise or
    // bias that is forgotten, more work than it takes.
    let folder = Folder::new();
    let folder_of_scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    let scene = format!("{folder_of_scenes}/cornell-diffuse.obj --size 32x32");
    folder
        .run(&format!("pm-picture -q {scene} --samples 400 --gathers 4 -n 300000 -k 8 --seed 99 --image best.exr"))
        .ok();
    let planned = folder.run(&format!("pm-plan --error 8% {scene} {LITTLE} -q")).ok();
    let pipe = planned.text().lines().next().expect("a pipe").to_owned();
    assert!(pipe.starts_with("pm-picture ") && planned.text().contains("next best "), "{}", planned.text());
    let mut errors: Vec<f64> = (1..=3)
        .map(|seed| {
            folder.sh(&format!("{pipe} -q --seed {seed}")).ok();
            error(&folder, "best.exr", "plan.exr")
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    let row = folder.run(&format!("pm-plan --error 8% {scene} {LITTLE} -q --format csv")).ok();
    assert!(row.text().starts_with("pipe,wanted,") && row.text().lines().count() == 2, "{}", row.text());
    // Two of three: one of many runs may be worse, as it says.
    assert!(errors[1] <= 0.08, "{errors:?} by {}", planned.text());
    assert!(errors[1] >= 0.02, "{errors:?}: far more was done than was asked for by {}", planned.text());
}

#[test]
fn what_cannot_be_promised_is_refused() {
    let folder = Folder::new();
    let lamp = "newmtl lamp\nKd 0 0 0\nKe 5 5 5\n";
    let room = "mtllib m.mtl\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nv -.2 1 -.2\nv .2 1 -.2\nv .2 1 .2\nv -.2 1 .2\n\
                usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
    folder.write("m.mtl", format!("newmtl floor\nKd .5 .5 .5\nKs .4 .4 .4\nNs 40\nillum 2\n{lamp}"));
    folder.write("room.obj", room);
    let view = "--eye 0,0.5,3 --look-at 0,0,0 --size 16x16";
    let refused = |line: &str, said: &str| {
        let outcome = folder.run(line);
        assert!(outcome.fails(4).contains(said), "{line}: {}", outcome.stderr);
        assert!(outcome.stdout.is_empty());
    };
    // Ks and Ns would be left out without a word.
    refused(&format!("pm-plan room.obj {view} --error 5% -q {LITTLE}"), "--glossy");
    let planned = folder.run(&format!("pm-plan room.obj {view} --error 10% -q {LITTLE} --anyway")).ok();
    assert!(planned.text().starts_with("pm-picture "), "{}", planned.text());
    // Nothing is seen: the eye looks away.
    let away = "--eye 0,0.5,3 --look-at 0,0.5,9 --size 16x16";
    refused(&format!("pm-plan room.obj {away} --error 5% -q --anyway {LITTLE}"), "no picture to plan");
    // A budget that nothing meets, and what could be had for it.
    let tight = format!("pm-plan room.obj {view} --error 30% --seconds 0.001 -q --anyway {LITTLE}");
    refused(&tight, "--seconds 0.001: an error of 30% takes");
}

#[test]
fn what_is_asked_wrongly_is_said() {
    let folder = Folder::new();
    for (line, said) in [
        ("pm-plan", "--error"),
        ("pm-plan --error 2", "such as 2%"),
        ("pm-plan --error 2% --confidence 100%", "99.9%"),
        ("pm-plan --error 2% --seconds 0", "above 0"),
        ("pm-plan --error 2% --glossy --anyway", "--anyway"),
    ] {
        let outcome = folder.run(line);
        assert!(outcome.code == 2 && outcome.stderr.contains(said), "{line}: {}", outcome.stderr);
    }
}
