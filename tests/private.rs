//! Is one processing element one cache, and what is asked of several refused where it means nothing?

use crate::support::Folder;
use serde_json::Value;

fn rows(folder: &Folder, options: &str) -> Vec<Value> {
    let json = folder.run(&format!("pm-cachesim -q --format json {options}")).ok();
    let json: Value = serde_json::from_str(json.text()).expect("JSON");
    json["rows"].as_array().expect("rows").clone()
}

fn folder() -> Folder {
    let folder = Folder::with_streams();
    folder
        .sh(&format!(
            "pm-queries {} --order tiled | pm-reorder hilbert --per batch | pm-gather map.pmp -o t.pmt",
            crate::support::SMALL
        ))
        .ok();
    folder
}

#[test]
fn one_element_has_the_row_of_one_cache() {
    let folder = folder();
    let plain = rows(&folder, "--sizes 1K,4K,64K t.pmt");
    for from in ["stream", "parts", "batches"] {
        let private = rows(&folder, &format!("--sizes 1K,4K,64K --private 1 --private-from {from} t.pmt"));
        assert_eq!(private.len(), plain.len());
        for (private, plain) in private.iter().zip(&plain) {
            assert_eq!((&private["private"], &private["lines_shared"]), (&Value::from(1), &Value::from(0)));
            for (name, value) in plain.as_object().expect("a row") {
                assert_eq!(value, &private[name], "{from}: {name} of {}", plain["cache"]);
            }
        }
    }
    // A chain of caches is what a stream of misses says.
    folder.sh("pm-cachesim --cache 4K,full,128,lru --misses m.pmt t.pmt > m.txt").ok();
    let behind = rows(&folder, "--cache 16K,full,128,lru m.pmt");
    let shared = rows(&folder, "--cache 4K,full,128,lru --private 1,3 --shared 16K,full,128,lru t.pmt");
    assert_eq!(shared[0]["shared_fetches"], behind[0]["fetches"]);
    assert_eq!(shared[1]["accesses"], plain[1]["accesses"]);
    assert_ne!(shared[1]["fetches"], shared[0]["fetches"]);
    assert!(shared[1]["lines_shared"].as_u64() > Some(0) && shared[1]["page_switches"].is_null(), "{shared:?}");
}

#[test]
fn what_has_no_meaning_is_refused() {
    let folder = folder();
    folder.run("pm-sample --every 64 --window 16 --warm-up 4 q.pmq -o w.pmq").ok();
    folder.run("pm-gather map.pmp w.pmq -o w.pmt").ok();
    folder.write("din", "0 1000\n1 1008\n");
    for (options, says) in [
        ("--private 2 w.pmt", "--private"),
        ("--private 2 --input din din", "no searches"),
        ("--private 2 --sizes 1K,2K --shared 4K,full,128,lru t.pmt", "one cache of each element"),
    ] {
        let outcome = folder.run(&format!("pm-cachesim {options}"));
        assert!(outcome.fails(2).contains(says), "{outcome:?}");
    }
    let none = folder.run("pm-cachesim --private 2 --cache none --shared 4K,full,128,lru t.pmt");
    assert!(none.code != 0 && none.stderr.contains("without a cache"), "{none:?}");
    for options in ["--lanes 2 --private 2", "--curve --private 2", "--private-from parts", "--shared 4K,full,128,lru"]
    {
        let outcome = folder.run(&format!("pm-cachesim {options} t.pmt"));
        assert_eq!(outcome.code, 2, "{outcome:?}");
    }
}
