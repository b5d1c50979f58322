//! Are material libraries found and read as exporters write them?

use super::support::{LAMP, SQUARE, load, load_files, strict_error};
use crate::scene::{LoadOptions, Scene};

/// Does a byte-order mark before `mtllib` lose the materials?
#[test]
fn byte_order_mark() {
    let obj = format!("\u{feff}mtllib m.mtl\n{SQUARE}usemtl lamp\nf 1 2 3 4\n");
    assert!(load(obj).unwrap().material_of(0).emits());
}

/// Are `mtllib` lists and names with spaces told apart, and paths with backslashes found?
#[test]
fn library_lists_and_names_with_spaces() {
    let obj = |lib: &str| format!("mtllib {lib}\n{SQUARE}usemtl lamp\nf 1 2 3\nusemtl other\nf 1 3 4\n");
    let other: &[u8] = b"newmtl other\nKd 1 0 0\n";
    let both = [LAMP.as_bytes(), other].concat();
    let red = |scene: Scene| assert_eq!(scene.material_of(1).diffuse, [1.0, 0.0, 0.0]);
    let options = LoadOptions::default();
    red(load_files(
        &[("t.obj", obj("a.mtl b.mtl").as_bytes()), ("a.mtl", LAMP.as_bytes()), ("b.mtl", other)],
        &options,
    )
    .unwrap());
    red(load_files(&[("t.obj", obj("a b.mtl").as_bytes()), ("a b.mtl", &both)], &options).unwrap());
    red(load_files(&[("d/t.obj", obj("lib\\a.mtl").as_bytes()), ("d/lib/a.mtl", &both)], &options).unwrap());
    let one = [("t.obj", &obj("a.mtl b.mtl").into_bytes()[..]), ("a.mtl", &both)];
    let said = "t.obj:1: material library \"b.mtl\": no such file; put it beside the OBJ or correct the mtllib line";
    let scene = load_files(&one, &options).unwrap();
    assert_eq!(scene.warnings, [format!("{said}: its materials are grey 0.5")]);
    red(scene);
    assert_eq!(load_files(&one, &LoadOptions { strict: true, ..options }).unwrap_err().to_string(), said);
}

/// Does a `usemtl` above its `mtllib`, or split by a tab, find its material?
#[test]
fn library_after_use_and_tabs() {
    let scene = load(format!("{SQUARE}usemtl\tlamp\nf 1 2 3 4\nmtllib\tm.mtl\nmtllib m.mtl\n")).unwrap();
    assert!(scene.material_of(0).emits());
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

/// Are names found that have blanks, quotes, or the path of another machine, and those that are not there named?
#[test]
fn names_as_exporters_write_them() {
    let with = |statement: &str, there: &[&str]| {
        let obj = format!("{statement}\n{SQUARE}usemtl lamp\nf 1 2 3 4\n");
        let mut files = vec![("d/t.obj", obj.as_bytes())];
        files.extend(there.iter().map(|name| (*name, LAMP.as_bytes())));
        load_files(&files, &LoadOptions { allow_dark: true, ..Default::default() }).unwrap()
    };
    let lit = |statement: &str, there: &[&str]| {
        let scene = with(statement, there);
        assert!(scene.material_of(0).emits(), "{statement}: {:?}", scene.warnings);
        scene.warnings
    };
    let none: [&str; 0] = [];
    assert_eq!(lit("mtllib my room.mtl", &["d/my room.mtl"]), none);
    assert_eq!(lit("mtllib \"my room.mtl\"", &["d/my room.mtl"]), none);
    assert_eq!(lit("mtllib your room.mtl my room.mtl", &["d/my room.mtl", "d/your room.mtl"]), none);
    assert_eq!(lit("mtllib \"x.mtl\" \"my room.mtl\" # both", &["d/my room.mtl"]).len(), 1);
    assert_eq!(lit("mtllib m.mtl # the room", &["d/m.mtl"]), none);
    for foreign in ["C:\\models\\x.mtl", "/home/x/x.mtl", "./a/x.mtl"] {
        let said = lit(&format!("mtllib {foreign}"), &["d/x.mtl"]);
        assert!(said.len() == 1 && said[0].ends_with("d/x.mtl is taken for it"), "{said:?}");
    }
    let said = lit("mtllib a.mtl b.mtl c.mtl", &["d/c.mtl"]);
    assert!(said.len() == 2 && said[0].contains("\"a.mtl\"") && said[1].contains("\"b.mtl\""), "{said:?}");
    let said = with("mtllib no such room.mtl", &[]).warnings;
    assert!(said[0].contains("\"no such room.mtl\": no such file") && said.len() == 3, "{said:?}");
    let said = with("mtllib", &[]).warnings;
    assert!(said[0].starts_with("d/t.obj:1: mtllib without a name"), "{said:?}");
}

/// Is a missing library named, an error to a strict reading, and an unknown material grey with a warning?
#[test]
fn missing_library_and_unknown_material() {
    let gone = format!("# x\nmtllib gone.mtl\n{SQUARE}f 1 2 3\n");
    assert!(load(&gone).unwrap().warnings[0].starts_with("t.obj:2: material library \"gone.mtl\": no such file"));
    let missing = strict_error(gone);
    assert_eq!(
        missing,
        "t.obj:2: material library \"gone.mtl\": no such file; put it beside the OBJ or correct the mtllib line"
    );
    let scene =
        load(format!("mtllib m.mtl\n{SQUARE}usemtl lamp\nf 1 2 3\nusemtl nope\nf 1 3 4\nusemtl nope\n")).unwrap();
    assert_eq!(scene.material_of(1).diffuse, [0.5; 3]);
    assert!(!scene.material_of(1).emits(), "the material before must not go on");
    assert_eq!(
        scene.warnings[0],
        "t.obj:8: material \"nope\" is in no library; grey 0.5 takes its place (and 1 more like this)"
    );
}

/// Do one-number colours, spectra and bad numbers in a library keep to their own line?
#[test]
fn library_traps() {
    let obj = format!("mtllib m.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\n");
    let with = |mtl: &str| load_files(&[("t.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes())], &LoadOptions::default());
    let scene = with("newmtl a\nKd 0.5\nKe 1\nKs spectral file.rfl\n").unwrap();
    assert_eq!(scene.material_of(0).diffuse, [0.5; 3]);
    assert_eq!(scene.warnings.len(), 1);
    assert_eq!(with("newmtl a\nKd 0.5 0.5 x\n").unwrap_err().to_string(), "m.mtl:2: Kd: \"x\" is not a number");
}
