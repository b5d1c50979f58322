//! Are chains of misses as long as the maps are deep, and is all else as without them?

use crate::support::Folder;
use serde_json::Value;

fn rows(folder: &Folder, options: &str) -> Vec<Value> {
    let json = folder.run(&format!("pm-cachesim -q --format json {options}")).ok();
    let json: Value = serde_json::from_str(json.text()).expect("JSON");
    json["rows"].as_array().expect("rows").clone()
}

fn numbers(rows: &[Value], column: &str) -> Vec<f64> {
    rows.iter().map(|row| row[column].as_f64().unwrap_or_else(|| panic!("{column} in {row}"))).collect()
}

const CACHES: &str = "--cache none --cache 4K,full,128,lru --cache 8M,full,128,lru";

#[test]
fn chains_are_as_long_as_maps_are_deep() {
    let folder = Folder::with_streams();
    // 2,000 nodes are eleven levels, 334 leaves lie on the ninth and tenth; blocks come after buckets, and photons after the cells they are in.
    let maps = [("kd", 11), ("kd --layout veb", 11), ("bucket-kd", 10), ("block-hash", 2), ("grid", 2), ("brute", 1)];
    for (map, deepest) in maps {
        folder.run(&format!("pm-gather map.pmp q.pmq --waits --start-radius inf --map {map} -o c.pmt")).ok();
        folder.run(&format!("pm-gather map.pmp q.pmq --start-radius inf --map {map} -o t.pmt")).ok();
        let found = rows(&folder, &format!("{CACHES} --miss-chain c.pmt"));
        let (chains, longest) = (numbers(&found, "miss_chain"), numbers(&found, "miss_chain_max"));
        assert_eq!(longest[0], f64::from(deepest), "{map}");
        // Some searches may not see the deepest level, where not all leaves are.
        assert!(chains[0] > longest[0] - 1.0 && chains[0] <= longest[0], "{map}: {chains:?}");
        assert!(chains[2] < chains[1] && chains[1] <= chains[0], "{map}: {chains:?}");
        let fetches = numbers(&found, "fetches_per_query");
        assert!(chains.iter().zip(&fetches).all(|(chain, fetches)| chain <= fetches), "{map}: {chains:?} {fetches:?}");
        // Nothing else differs.
        for (found, plain) in found.iter().zip(rows(&folder, &format!("{CACHES} t.pmt"))) {
            for (name, value) in plain.as_object().expect("a row") {
                assert!(value == &found[name] || ["trace", "history"].contains(&name.as_str()), "{map}: {name}");
            }
        }
    }
}

#[test]
fn what_has_no_chains_is_refused() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    folder.run("pm-gather --waits map.pmp q.pmq -o c.pmt").ok();
    folder.run("pm-sample --every 64 --window 16 --warm-up 4 q.pmq -o w.pmq").ok();
    folder.run("pm-gather --waits map.pmp w.pmq -o w.pmt").ok();
    folder.write("din", "0 1000\n1 1008\n");
    for (line, says) in [
        ("pm-cachesim --miss-chain t.pmt", "no read of this trace says what it waits for"),
        ("pm-cachesim --miss-chain --input din din", "no read of this trace says what it waits for"),
        ("pm-cachesim --miss-chain w.pmt", "what a window does not know"),
        ("pm-gather --waits --map wide map.pmp q.pmq -o x.pmt", "`wide` do not tell what their reads wait for"),
        ("pm-gather --waits --pad map.pmp q.pmq -o x.pmt", "packed records"),
    ] {
        let outcome = folder.run(line);
        assert!(outcome.fails(2).contains(says), "{outcome:?}");
    }
    for line in [
        "pm-cachesim --miss-chain --lanes 2 c.pmt",
        "pm-cachesim --miss-chain --curve c.pmt",
        "pm-gather --waits --reread map.pmp q.pmq -o x.pmt",
        "pm-gather --waits --carry map.pmp q.pmq -o x.pmt",
        "pm-gather --waits --precomputed map.pmp q.pmq -o x.pmt",
        "pm-gather --waits --no-trace map.pmp q.pmq --image x.exr",
    ] {
        let outcome = folder.run(line);
        assert!(outcome.code == 2 && outcome.stderr.contains("cannot be used with"), "{outcome:?}");
    }
    assert!(!folder.path("x.pmt").exists());
}

#[test]
fn a_trace_of_chains_is_a_trace() {
    let folder = Folder::with_streams();
    folder.run("pm-gather --waits map.pmp q.pmq --map bucket-kd -o c.pmt").ok();
    folder.run("pm-view --check c.pmt").ok();
    folder.run("pm-view --archive c.pmt -o a.pmt").ok();
    let found = rows(&folder, "--miss-chain c.pmt a.pmt");
    assert_eq!(found[0]["miss_chain"], found[1]["miss_chain"]);
    let header = folder.run("pm-view c.pmt").ok();
    assert!(header.text().contains("each read says what it waits for"), "{}", header.text());
}
