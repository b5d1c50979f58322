//! Do curves, samples, chains of caches and the columns beside the fetches agree with one another, through the program?

use crate::support::{Folder, same_bytes, same_text};
use serde_json::Value;
use std::collections::BTreeSet;

/// A folder with `t.pmt` of queries in this order.
fn trace(order: &str, deferred: &str) -> Folder {
    let folder = Folder::with_streams();
    folder.run(&format!("pm-queries --size 16x12 --gathers 4 --order {order} -o q.pmq")).ok();
    folder.sh(&format!("pm-reorder {deferred} -q q.pmq | pm-gather -k 20 map.pmp -o t.pmt")).ok();
    folder
}

fn rows(folder: &Folder, options: &str) -> Vec<Value> {
    let json = folder.run(&format!("pm-cachesim --format json {options}")).ok();
    let json: Value = serde_json::from_str(json.text()).expect("JSON");
    assert_eq!(json["schema"], 1);
    json["rows"].as_array().expect("rows").clone()
}

fn count(row: &Value, column: &str) -> u64 {
    row[column].as_u64().unwrap_or_else(|| panic!("{column} in {row}"))
}

#[test]
fn a_curve_says_what_caches_one_by_one_say() {
    let folder = trace("scanline", "hilbert");
    let curve = rows(&folder, "--curve --lines 32,128 t.pmt");
    let sizes: Vec<&Value> = curve.iter().filter(|row| count(row, "cache_lines").is_multiple_of(7)).collect();
    assert!(sizes.len() > 10, "{}", sizes.len());
    let caches: Vec<String> = sizes.iter().map(|row| format!("--cache {}", row["cache"].as_str().unwrap())).collect();
    let singles = rows(&folder, &format!("{} t.pmt", caches.join(" ")));
    assert_eq!(singles.len(), sizes.len());
    let same =
        ["queries", "reads", "accesses", "fetches", "bytes_fetched", "bytes_written_back", "compulsory", "blocks"];
    for (single, point) in singles.iter().zip(sizes) {
        for column in same.into_iter().chain(["capacity", "fetches_per_query", "fetches_per_block", "bytes_per_query"])
        {
            assert_eq!(single[column], point[column], "{column} of {}", single["cache"]);
        }
    }
    for line in [32, 128] {
        let of_line: Vec<&Value> =
            curve.iter().filter(|row| row["cache"].as_str().unwrap().contains(&format!(",full,{line},"))).collect();
        assert!(of_line.windows(2).all(|pair| pair[0]["fetches"].as_u64() > pair[1]["fetches"].as_u64()));
        assert_eq!(of_line.last().unwrap()["fetches"], of_line[0]["compulsory"]);
        assert_eq!(of_line.iter().filter(|row| row["mark"] == "cliff").count(), 1);
    }
    // The sizes asked for, whatever else the curve has.
    let doubled = rows(&folder, "--curve --sizes 1K..8K,24K --lines 64 t.pmt");
    let names: Vec<&str> = doubled.iter().map(|row| row["cache"].as_str().unwrap()).collect();
    assert_eq!(names, ["1K", "2K", "4K", "8K", "24K"].map(|size| format!("{size},full,64,lru")));
    let list = rows(&folder, "--sizes 1K..8K,24K --lines 64 t.pmt");
    for (a, b) in list.iter().zip(&doubled) {
        assert_eq!((&a["cache"], &a["fetches"]), (&b["cache"], &b["fetches"]));
    }
    // The table is short.
    let table = folder.run("pm-cachesim --curve t.pmt").ok();
    assert!((4..20).contains(&table.text().lines().count()), "{}", table.text());
}

#[test]
fn columns_add_up() {
    let folder = trace("tiled --tile 4", "hilbert --per batch");
    for row in rows(&folder, "--sizes 1K,16K --ways full,2 --lines 64 t.pmt") {
        let fetches = count(&row, "fetches");
        let split = (count(&row, "compulsory") + count(&row, "capacity")) as i64 + row["conflict"].as_i64().unwrap();
        assert_eq!(split, fetches as i64);
        let names: Vec<&String> = row.as_object().unwrap().keys().filter(|name| name.starts_with("fetches_")).collect();
        let regions = names.iter().filter(|name| !name.starts_with("fetches_per_") && !name.ends_with("_error"));
        assert_eq!(regions.map(|name| count(&row, name)).sum::<u64>(), fetches);
        assert!(count(&row, "page_switches") < fetches);
        assert_eq!(count(&row, "searches"), count(&row, "queries"));
        assert_eq!(count(&row, "batches"), 12, "16 x 12 pixels in tiles of 4 x 4");
        assert!(count(&row, "compulsory") <= count(&row, "batch_floor"));
        assert!(count(&row, "lines_per_search_p50") <= count(&row, "lines_per_search_p90"));
        assert!(count(&row, "lines_per_search_p90") <= count(&row, "lines_per_search_max"));
        let total = count(&row, "bytes_fetched") + count(&row, "query_bytes") + count(&row, "result_bytes");
        assert_eq!(count(&row, "total_bytes"), total);
    }
    // A 4 x 4 tile has rows of 48 bytes: aligned to one and a half sectors, so two at most; each written once.
    let result = count(&rows(&folder, "t.pmt")[0], "result_bytes");
    assert!((1..=16 * 12 * 32).contains(&result) && result.is_multiple_of(32), "{result}");
    // The same queries without tiles are read and written: twice the sectors that they touch, if the cache holds all.
    folder.run("pm-queries --size 16x12 --gathers 4 -o s.pmq").ok();
    folder.run("pm-gather -k 20 map.pmp s.pmq -o s.pmt").ok();
    let touched = 16 * 12 * 12 / 32;
    let result = count(&rows(&folder, "--result-cache 1M s.pmt")[0], "result_bytes");
    assert!(result <= 2 * 32 * touched, "{result}");
    let without = count(&rows(&folder, "--result-cache 0 s.pmt")[0], "result_bytes");
    assert!(without > 4 * result, "{without} bytes without a cache, {result} with one");
    // Records in two lines are one access if only their first byte counts.
    let row = &rows(&folder, "--span first --lines 64 s.pmt")[0];
    assert_eq!(row["accesses"], row["reads"]);
}

#[test]
fn caches_chain() {
    let folder = trace("scanline", "random");
    let first = folder.run("pm-cachesim --cache 2K,4,64,lru --misses l1.pmt --format json t.pmt").ok();
    let first: Value = serde_json::from_str(first.text()).unwrap();
    let first = &first["rows"][0];
    folder.run("pm-view --check l1.pmt").ok();
    // As if the table had been asked for alone.
    assert_eq!(*first, rows(&folder, "--cache 2K,4,64,lru t.pmt")[0]);
    let second = &rows(&folder, "--cache none,64 --cache 16K,full,64,lru l1.pmt");
    assert_eq!(second[0]["raw_bytes"], first["bytes_fetched"]);
    assert_eq!(second[0]["queries"], first["queries"]);
    assert_eq!(second[0]["order"], "scanline, random, misses of 2K,4,64,lru");
    assert!(count(&second[1], "fetches") < count(first, "fetches"));
    assert_eq!(count(&second[1], "compulsory"), count(first, "compulsory"), "the second sees every line once");
    // A pipe has the stream, the same byte by byte, and no table.
    let stream = folder.run("pm-cachesim --misses=- --cache 2K,4,64,lru t.pmt").ok().stdout;
    folder.run("pm-cachesim --misses=x.pmt --format=csv --cache 2K,4,64,lru t.pmt").ok();
    same_bytes("stream", &stream, &folder.read("x.pmt"));
    let piped =
        folder.sh("pm-cachesim --cache 2K,4,64,lru --misses - t.pmt | pm-cachesim --cache 16K,full,64,lru").ok();
    same_text("pipe", folder.run("pm-cachesim --cache 16K,full,64,lru l1.pmt").ok().text(), piped.text());
    let history = folder.run("pm-view --history l1.pmt").ok();
    assert!(history.text().contains("pm-cachesim --cache 2K,4,64,lru --misses - t.pmt"), "{}", history.text());
    // Half a trace has no misses.
    let whole = folder.read("t.pmt");
    folder.write("half.pmt", &whole[..whole.len() - 1]);
    let names: BTreeSet<String> = folder.names().into_iter().collect();
    let _ = folder.run("pm-cachesim --cache 2K,4,64,lru --misses l2.pmt half.pmt").fails(3);
    assert_eq!(folder.names().into_iter().collect::<BTreeSet<_>>(), names, "nothing is left of it");
}

#[test]
fn a_sample_says_how_far_it_may_be_off_or_nothing() {
    let folder = trace("scanline", "hilbert");
    // 2,000 photons are 313 lines of 128 bytes.
    let outcome = folder.run("pm-cachesim --shards 0.1 t.pmt");
    assert!(outcome.fails(2).contains("only of 1000 and more"), "{}", outcome.stderr);
    let outcome = folder.run("pm-cachesim --shards 0.5 --sizes 16K t.pmt");
    assert!(outcome.fails(2).contains("128 lines, only of 200 and more"), "{}", outcome.stderr);
    let both = rows(&folder, "--curve --shards 0.5 --lines 32 t.pmt");
    assert!(!both.is_empty());
    for row in &both {
        assert!(count(row, "cache_lines") >= 200);
        let (exact, sampled) = (row["fetches"].as_f64().unwrap(), row["sampled_fetches"].as_f64().unwrap());
        assert!((row["sampled_off"].as_f64().unwrap() - (sampled / exact - 1.0)).abs() < 1e-9);
        assert!(row["plus_or_minus"].as_f64().unwrap() >= 0.0);
    }
    let alone = rows(&folder, "--shards 0.5 --lines 32 t.pmt");
    assert_eq!(alone.len(), both.len());
    assert!(alone[0].get("fetches").is_none() && alone[0]["sampled_fetches"] == both[0]["sampled_fetches"]);
}
