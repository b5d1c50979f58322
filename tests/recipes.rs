//! `pm-picture`: is what it prints what it does?

use crate::support::{Folder, same_bytes};

const SMALL: &str = "--size 16x12 --samples 4 -n 3000 --caustics 500";

#[test]
fn the_pipes_that_are_printed_make_the_picture() {
    // Catches: an option that is printed and not given or the other way round, words that a shell takes apart, pictures that
    // depend on the folder of the streams or on threads.
    let folder = Folder::new();
    folder.run("pm-scene gap -q -o room.obj").ok();
    for name in ["obj", "mtl", "camera.toml"] {
        let text = folder.read(&format!("room.{name}"));
        folder.write(&format!("my room.{name}"), text);
    }
    for (case, lines) in [
        (format!("pm-picture {SMALL} --eye -0.1,0.5,1.9 --vfov 30 --clear-glass --seed 3"), 4),
        (
            "pm-picture --size 16x12 -n 3000 --caustics 0 --samples 2 --gathers 3 --light-samples 2 -k 5 \
          --map kd --queries '--min-gather-dist 0.01' --gather '--precomputed --edges sloped'"
                .to_owned(),
            2,
        ),
        (format!("pm-picture 'my room.obj' {SMALL} --guide --exposure -1"), 2),
    ] {
        let printed = folder.sh(&format!("{case} --image x.exr --image x.png --dry-run")).ok().text().to_owned();
        assert_eq!(printed.lines().count(), lines, "{printed}");
        assert!(!folder.names().iter().any(|name| name.ends_with(".pmp") || name.starts_with("x.")), "it ran");
        folder.sh(&printed).ok();
        let typed = [folder.read("x.exr"), folder.read("x.png")];
        for options in ["-t 2", "--keep kept"] {
            let done = folder.sh(&format!("{case} --image y.exr --image y.png {options}")).ok();
            assert_eq!(done.text().lines().count(), lines);
            same_bytes(&format!("{case} {options}, x.exr"), &typed[0], &folder.read("y.exr"));
            same_bytes(&format!("{case} {options}, x.png"), &typed[1], &folder.read("y.png"));
        }
        assert!(folder.path("kept/map.pmp").exists() && folder.path("kept/direct.exr").exists());
        for name in folder.names() {
            let streams = name.ends_with(".pmp") || name.starts_with("x.");
            assert!(!streams || std::fs::remove_file(folder.path(&name)).is_ok());
        }
    }
}

#[test]
fn caustics_have_a_map_where_there_are_any() {
    // Catches: a map for the mirror that no light meets, which would be looked for without end; none for glass that focuses.
    let folder = Folder::new();
    let room = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nv -.1 1 -.1\nv .1 1 -.1\nv .1 1 .1\nv -.1 1 .1\n\
                usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
    let mirror = |y: f32| format!("v -1 {y} 1\nv 1 {y} 1\nv 0 {y} 2\nusemtl mirror\nf 9 10 11\n");
    folder.write(
        "m.mtl",
        "newmtl floor\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 5 5 5\nnewmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 3\n",
    );
    // Above the lamp, which shines downward, and in its light, tilted so that the floor gets some of it.
    folder.write("above.obj", format!("mtllib m.mtl\n{room}{}", mirror(2.0)));
    let tilted = "v .3 .2 .5\nv .3 .2 -.5\nv .6 .8 0\nusemtl mirror\nf 9 10 11\n";
    folder.write("tilted.obj", format!("mtllib m.mtl\n{room}{tilted}"));
    for (scene, lines) in [("above.obj", 2), ("tilted.obj", 4)] {
        let line = format!("pm-picture {scene} {SMALL} --eye 0,1.5,2 --look-at 0,0,0 --image x.exr");
        assert_eq!(folder.run(&line).ok().text().lines().count(), lines, "{scene}");
    }
}

#[test]
fn what_is_asked_wrongly_is_said_before_anything_runs() {
    let folder = Folder::new();
    for (line, code, said) in [
        ("pm-picture --image x.jpg", 2, ".exr"),
        ("pm-picture --image -", 2, "standard output"),
        ("pm-picture nosuch.obj --image x.exr", 1, "nosuch.obj"),
        ("pm-picture --samples 0 --image x.exr", 2, "--samples"),
        ("pm-picture --image nowhere/x.exr", 1, "no folder nowhere"),
        ("pm-picture --vfov 0 --image x.exr", 1, "vfov"),
        ("pm-picture --map nosuch --image x.exr", 2, "wide"),
        ("pm-picture --caustics 0 --caustics-k 9 --image x.exr", 2, "--caustics-k"),
    ] {
        let outcome = folder.run(line);
        assert!(outcome.code == code && outcome.stderr.contains(said), "{line}: {}", outcome.stderr);
        assert!(folder.names().is_empty(), "{line}");
    }
    // One of the programs fails: it says why, and so does pm-picture.
    std::fs::create_dir_all(folder.path("kept/map.pmp")).unwrap();
    let outcome = folder.run(&format!("pm-picture {SMALL} --image x.exr --keep kept"));
    assert!(outcome.code == 2 && outcome.stderr.contains("pm-photons failed"), "{}", outcome.stderr);
    assert_eq!(folder.names(), ["kept"]);
}
