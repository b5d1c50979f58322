//! Are photons of one scene and queries of another told apart, and only those?

use crate::support::{Folder, same_bytes};

/// A floor with a lamp above it, painted and lit as asked.
fn room(folder: &Folder, name: &str, paint: &str, light: &str) {
    folder.write(&format!("{name}.mtl"), format!("newmtl floor\nKd {paint}\nnewmtl lamp\nKd 0 0 0\nKe {light}\n"));
    let obj = format!(
        "mtllib {name}.mtl\nv -5 0 -5\nv -5 0 5\nv 5 0 5\nv 5 0 -5\nv -1 3 -1\nv 1 3 -1\nv 1 3 1\nv -1 3 1\n\
         usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n"
    );
    folder.write(&format!("{name}.obj"), obj);
    folder.run(&format!("pm-photons {name}.obj -n 500 -q -o {name}.pmp")).ok();
    let camera = "--eye 0,2,4 --look-at 0,0,0 --size 8x8 --gathers 2";
    folder.run(&format!("pm-queries {name}.obj {camera} -q -o {name}.pmq")).ok();
}

#[test]
fn other_materials_are_another_scene() {
    let folder = Folder::new();
    room(&folder, "grey", "0.5 0.5 0.5", "9 9 9");
    room(&folder, "black", "0.05 0.05 0.05", "9 9 9");
    room(&folder, "dim", "0.5 0.5 0.5", "1 1 1");
    room(&folder, "again", "0.5 0.5 0.5", "9 9 9");
    for other in ["black", "dim"] {
        let line = format!("pm-gather {other}.pmp grey.pmq -k 5 -o t.pmt");
        let message = folder.run(&line).fails(2).to_owned();
        assert!(message.contains(&format!("{other}.pmp and grey.pmq: of two scenes")), "{message}");
        assert!(message.contains("--anyway") && !folder.names().contains(&"t.pmt".into()));
        // Those who mean it are not told again.
        folder.run(&format!("{line} --anyway")).ok();
        std::fs::remove_file(folder.path("t.pmt")).unwrap();
    }
    // The same scene under another name is the same.
    folder.run("pm-gather again.pmp grey.pmq -k 5 -o t.pmt").ok();
}

#[test]
fn what_says_a_program_between_is_still_of_its_scene() {
    let folder = Folder::new();
    room(&folder, "grey", "0.5 0.5 0.5", "9 9 9");
    room(&folder, "dim", "0.5 0.5 0.5", "1 1 1");
    folder.run("pm-reorder hilbert grey.pmq -o h.pmq").ok();
    folder.run("pm-gather grey.pmp h.pmq -k 5 -o t.pmt").ok();
    assert!(folder.run("pm-gather dim.pmp h.pmq -k 5").fails(2).contains("of two scenes"));
}

#[test]
fn what_was_imported_says_nothing_of_a_scene() {
    let folder = Folder::new();
    room(&folder, "grey", "0.5 0.5 0.5", "9 9 9");
    folder.run("pm-view --records grey.pmp -o rows.csv").ok();
    let rows = folder.run("pm-view --records grey.pmp").ok();
    folder.write("rows.csv", &rows.stdout);
    folder.run("pm-view -q --import photons rows.csv -o imported.pmp").ok();
    // Not a word, and the same reads.
    let imported = folder.run("pm-gather imported.pmp grey.pmq -k 5 -q").ok().stdout;
    same_bytes("twice", &imported, &folder.run("pm-gather imported.pmp grey.pmq -k 5").ok().stdout);
}
