//! Is each typing mistake in a table refused with its file and line, in one line, before anything runs?

use super::{make, said, workshop};
use std::fs;

/// Tables, and what is said of them.
const MISTAKES: &[(&str, &str)] = &[
    // What nobody uses.
    ("point,order,k,photons\n{order}.{k},scanline,10 20,-n 500\n", "my.csv:1: no line uses the column `k`: say {k}"),
    ("k,photons\n10,-n 500\n", "my.csv:1: no line uses the column `k`"),
    ("k,photons,gather\n10,-n 500,-k {k}\n20,-n 500,\n", "my.csv:3: nothing in this line uses `k`: say {k}"),
    ("order,photon\nscanline,-n 500\n", "my.csv:1: no line uses the column `photon`: did you mean `photons`?"),
    ("ordre,photons\nscanline,-n 500\n", "my.csv:1: no line uses the column `ordre`: did you mean `order`?"),
    ("order,note,photons\ntiled,,-n 500\n", "my.csv:1: no line uses the column `note`"),
    ("order,command\ntiled,pm-view {photons}\n", "my.csv:1: no line uses the column `order`"),
    ("point,gather,command\na,-k 5,echo\n", "my.csv:2: the command does not use what stands in the column `gather`"),
    ("point,photons,command\na,-n 5,echo\n", "my.csv:2: the command does not use what stands in the column `photons`"),
    // Words.
    ("order,photons\nzigzag,-n 500\n", "my.csv:2: `zigzag` is no order that scripts/words.csv knows"),
    ("order\nscanlin\n", "my.csv:2: `scanlin` is no order that scripts/words.csv knows; did you mean `scanline`?"),
    ("order\nhilbert\n", "my.csv:2: `hilbert` adds nothing by itself, and no stage says `hilbert`"),
    ("k,gather\n5,-k {q}\n5,-k {k}\n", "my.csv:2: nothing in this line uses `k`"),
    ("k,gather\n5,-k {k} {q}\n", "my.csv:2: {q} stands for nothing in `gather`; there are {k}, {photons}, {queries}"),
    ("k,gather\n5,-k {k}\n,-k {k}\n", "my.csv:3: nothing stands for {k} in this line"),
    ("(k),point,gather\n5,a,-k {k}\n", "my.csv:2: `k` is a remark here, and {k} uses it"),
    ("(k)\n5 6\n", "my.csv:2: `k` is a remark here, and `5 6` would be 2 points that do the same"),
    // Points.
    ("point,order\na,scanline tiled\n", "my.csv:2: the point a stands twice"),
    ("k,gather\n1,-k {k}\n1,-k {k} --reread\n", "my.csv:3: the point 1 stands twice in the table (line 2)"),
    ("start\nauto auto\n", "my.csv:2: the point auto stands twice"),
    ("strata,touch\nraster,once\n\nraster,once twice\n", "my.csv:4: the point raster.once stands twice"),
    (
        "order,queries\nhilbert scanline,| pm-reorder hilbert\n",
        "my.csv:2: the points hilbert and scanline run the same",
    ),
    // What make or a shell would misread.
    ("order,photons\ntiled,-n 500 # few\n", "my.csv:2: a remark is a line of its own"),
    ("order,command\ntiled,echo 'x' {order}\n", "my.csv:2: no ' may stand in what runs"),
    ("k,gather\na:b,-k {k}\n", "my.csv:2: the point `a:b` names a file, and make would misread `:`"),
    ("k,gather\n5%,-k {k}\n", "make would misread `%`"),
    ("k,gather\na=b,-k {k}\n", "make would misread `=`"),
    ("point,k,gather\na {k},5,-k {k}\n", "make would misread ` `"),
    ("point,k,gather\n../{k},5,-k {k}\n", "my.csv:2: the point `../5` names no file below out/"),
    ("point,scene\na,my scenes/a.obj\n", "my.csv:2: `my` is no OBJ file"),
    ("point,scene\na,a:b.obj\n", "my.csv:2: `a:b.obj`: make would misread"),
    ("point,scene\na,a$b.obj\n", "my.csv:2: `a$b.obj`: make would misread"),
    ("point,needs\na,x#y\n", "my.csv:2: `x#y`: make would misread"),
    ("point,queries\na,x || y || z\n", "my.csv:2: || stands twice"),
    // The table itself.
    ("order,photons\nscanline,-n 500,x\n", "my.csv:2: has 3 cells"),
    ("order,photons,order\n", "my.csv:1: the column `order` stands twice"),
    ("order\n\"tiled\n", "my.csv:2: a quote is not closed"),
    ("order,queries\nscanline,--size $(NO_SUCH)\n", "my.csv:2: $(NO_SUCH) has no value"),
    ("order,queries\n", "there is no point in"),
];

#[test]
fn mistakes_in_a_table_are_named_with_their_line() {
    let folder = workshop();
    for (table, why) in MISTAKES {
        folder.write("my.csv", table);
        let outcome = folder.run("pm-sweep rules my.csv");
        assert!(outcome.fails(2).contains(why), "{table}\n{why}\n{}", outcome.stderr);
        assert!(outcome.stdout.is_empty());
    }
}

#[test]
fn make_says_them_and_runs_nothing() {
    let folder = workshop();
    folder.write("my.csv", MISTAKES[0].0);
    let outcome = make(&folder, "sweep SWEEP=my.csv");
    assert!(!outcome.status.success());
    assert!(said(&outcome).contains(MISTAKES[0].1) && !said(&outcome).contains("pm-photons"), "{}", said(&outcome));
    assert!(!folder.path("out/rules.mk").exists());
}

#[test]
fn a_table_of_a_name_that_is_taken_is_refused() {
    let folder = workshop();
    fs::create_dir(folder.path("mine")).unwrap();
    for (name, why) in [
        ("full", "mine/full.csv:1: there is a `full` already, that is scripts/sweeps/full.csv"),
        ("coverage", "mine/coverage.csv:1: there is a `coverage` already"),
        ("scanline", "mine/scanline.csv:1: there is a `scanline` already"),
    ] {
        folder.write(&format!("mine/{name}.csv"), super::TABLE);
        let outcome = make(&folder, &format!("sweep SWEEP=mine/{name}.csv"));
        assert!(!outcome.status.success() && said(&outcome).contains(why), "{}", said(&outcome));
    }
}

/// Whatever the makefiles make in `out` is a name that no table of a user's can have.
#[test]
fn all_names_that_make_uses_are_taken() {
    let folder = workshop();
    let outcome = make(&folder, "--eval=names:;@echo$${IFS}=$(TAKEN)= names");
    let text = said(&outcome);
    let taken: Vec<&str> = text.split('=').nth(1).unwrap_or_else(|| panic!("{text}")).split_whitespace().collect();
    let tables = fs::read_dir(folder.path("scripts/sweeps")).unwrap();
    let tables: Vec<String> = tables.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    let makefiles = fs::read_dir(folder.path("scripts")).unwrap().map(|entry| entry.unwrap().path());
    let makefiles = makefiles.filter(|path| path.extension().is_some_and(|ending| ending == "mk"));
    for path in makefiles.chain([folder.path("Makefile")]) {
        for after in fs::read_to_string(&path).unwrap().split("out/").skip(1) {
            let name: String = after.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
            let is_file = after[name.len()..].starts_with(['/', '.']);
            let known = taken.contains(&name.as_str()) || tables.contains(&format!("{name}.csv"));
            // What cannot be the name of a table, or of what make makes.
            let special = name.is_empty() || !is_file || ["rules", "stability", "SWEEP", "my"].contains(&name.as_str());
            assert!(known || special, "{}: out/{name} may be that of a user's table: add it to TAKEN", path.display());
        }
    }
}
