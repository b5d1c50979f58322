//! Does the table of `make accuracy` fail when it must?

use crate::support::Folder;

/// What is known.
const KNOWN: &str = "accuracy.csv";

/// A folder with rows of experiments that are near enough to what is known here.
fn folder() -> Folder {
    let folder = Folder::new();
    let path = format!("{}/../../scripts/{KNOWN}", env!("CARGO_MANIFEST_DIR"));
    folder.write(KNOWN, std::fs::read(path).expect("a table"));
    folder.write(
        "known.csv",
        "experiment,part,what,r,g,b,se_r,se_g,se_b,tolerance,from\n\
         wall,0 0 4 4 - 0 0 2 2,wall,1,2,3,,,,1 %,here\n\
         flux,floor,flux,0.5,0.5,0.5,3e-3,3e-3,3e-3,3 SE,here\n\
         few,searches,searches,=many,,,,,,at most 0.3333,here\n",
    );
    // The rest of 16 pixels without 4: (16 x 1.75 - 4 x 4) / 12 = 1, and so on.
    wall(&folder, 1.75);
    folder.write("flux.csv", "name,r,g,b,se_r,se_g,se_b\nfloor,0.514,0.486,0.5,4e-3,4e-3,4e-3\n");
    folder.write("few.csv", "name,r,g,b\nsearches,33,,\n");
    folder.write("many.csv", "name,r,g,b\nsearches,100,,\n");
    folder
}

fn wall(folder: &Folder, red: f64) {
    let head = "picture,x0,y0,x1,y1,pixels,not_finite,r,g,b";
    folder.write("wall.csv", format!("{head}\nx,0,0,4,4,16,0,{red},2,3\nx,0,0,2,2,4,0,4,2,3\n"));
}

/// Exit code and table.
fn judged(folder: &Folder) -> (i32, String) {
    let outcome = folder.run("pm-sweep derive accuracy known.csv wall.csv flux.csv few.csv many.csv");
    assert_eq!(outcome.stderr.is_empty(), outcome.code == 0, "{}", outcome.stderr);
    (outcome.code, outcome.text().to_owned())
}

#[test]
fn what_is_near_enough_is_ok() {
    let (code, table) = judged(&folder());
    assert!(code == 0 && table.contains("all 3 rows are ok"), "{table}");
    assert!(table.contains("+2.80 SE") || table.contains("-2.80 SE"), "{table}");
    assert!(table.contains("x 0.3300"), "{table}");
}

#[test]
fn what_is_not_near_or_not_there_is_not_ok() {
    type Spoil = fn(&Folder);
    let spoils: [(&str, Spoil); 6] = [
        ("1.3 % too bright", |folder| wall(folder, 1.76)),
        ("no number", |folder| wall(folder, f64::NAN)),
        ("three standard errors", |folder| {
            folder.write("flux.csv", "name,r,g,b,se_r,se_g,se_b\nfloor,0.5,0.516,0.5,4e-3,4e-3,4e-3\n");
        }),
        ("too many searches", |folder| folder.write("few.csv", "name,r,g,b\nsearches,34,,\n")),
        ("an empty file", |folder| folder.write("few.csv", "")),
        ("nothing to compare with", |folder| folder.write("many.csv", "name,r,g,b\n")),
    ];
    for (what, spoil) in spoils {
        let folder = folder();
        spoil(&folder);
        let (code, table) = judged(&folder);
        assert!(code == 1 && table.contains("1 of 3 rows are NOT OK"), "{what}: exit {code}\n{table}");
    }
}

#[test]
fn every_row_says_where_its_value_is_from() {
    let folder = folder();
    let known = String::from_utf8(folder.read("accuracy.csv")).unwrap();
    let rows: Vec<Vec<&str>> =
        known.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').collect()).collect();
    assert!(rows.len() > 40);
    for row in &rows {
        assert_eq!(row.len(), rows[0].len(), "{row:?}");
        let source = row[row.len() - 1];
        // Whatever is not compared with another experiment is explained in the head.
        assert!(row[3].starts_with('=') || row == &rows[0] || known.contains(&format!("# {source}:")), "{row:?}");
    }
}
