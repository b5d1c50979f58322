//! Estimates from windows of a stream: beside what the whole stream gives, and what cannot be estimated.

use crate::support::Folder;
use serde_json::Value;

/// A picture of some thousand queries, and windows of it.
const SIZE: &str = "--size 32x24 --gathers 9";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.run("pm-photons -n 5000 -o map.pmp").ok();
    folder.run(&format!("pm-queries {SIZE} -o q.pmq")).ok();
    folder.run("pm-gather map.pmp q.pmq -o whole.pmt").ok();
    folder.run(&format!("pm-queries {SIZE} --only-tiles 60 --window 20 --warm-up 30 -o w.pmq")).ok();
    folder.run("pm-gather map.pmp w.pmq -o w.pmt").ok();
    folder
}

fn rows(folder: &Folder, line: &str) -> Vec<Value> {
    let json: Value = serde_json::from_str(folder.run(line).ok().text()).expect("JSON");
    json["rows"].as_array().expect("rows").clone()
}

fn number(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap_or_else(|| panic!("{name} is {}", row[name]))
}

#[test]
fn estimates_lie_about_what_the_whole_gives() {
    let folder = folder();
    let caches = "--cache 16K,full,128,lru --cache 8K,4,64,lru --cache none";
    let rows = rows(&folder, &format!("pm-cachesim {caches} --format json whole.pmt w.pmt"));
    let (whole, windows) = rows.split_at(3);
    for (whole, windows) in whole.iter().zip(windows) {
        for name in
            ["reads_per_query", "accesses_per_query", "fetches_per_query", "fetches_per_block", "bytes_per_query"]
                .iter()
                .chain(&["fetches", "bytes_fetched", "fetches_kd_nodes"])
        {
            let (truth, value) = (number(whole, name), number(windows, name));
            let half_width = number(windows, &format!("{name}_error"));
            assert!(half_width > 0.0 && half_width < 0.5 * value, "{name}: {value} +- {half_width}");
            // One in twenty intervals fails; three half widths are six standard errors.
            assert!((value - truth).abs() < 3.0 * half_width, "{name}: {value} +- {half_width}, not {truth}");
            assert_eq!(number(whole, &format!("{name}_error")), 0.0, "{name}");
        }
        for name in
            ["compulsory", "capacity", "conflict", "batch_floor", "lines_per_search_p50", "result_bytes", "total_bytes"]
        {
            assert!(windows[name].is_null(), "{name} is {}", windows[name]);
        }
        assert_eq!((number(whole, "windows"), number(windows, "windows")), (0.0, 60.0));
        assert_eq!(number(whole, "sample_share"), 1.0);
        assert!(number(windows, "sample_share") < 0.3 && number(windows, "degrees_of_freedom") > 10.0);
        assert!(number(windows, "queries_measured") < number(windows, "queries_simulated"));
        assert!(number(windows, "queries_simulated") < 60.0 * 50.0);
        assert_eq!(number(whole, "queries_simulated"), number(whole, "queries"));
        assert_eq!(number(whole, "blocks"), number(windows, "blocks"));
    }
    assert!(windows[0]["fetches_per_query_doubt"].as_f64() >= Some(0.0));
    assert_eq!(number(&windows[2], "windows_inexact"), 0.0, "without a cache nothing is to be filled");
    // A thinned stream has a label and no interval.
    folder.run("pm-sample --queries 8 q.pmq -o thin.pmq").ok();
    folder.run("pm-gather map.pmp thin.pmq -o thin.pmt").ok();
    let thin = &self::rows(&folder, "pm-cachesim --format json thin.pmt")[0];
    assert_eq!(thin["sample"], "1 of 8 queries");
    assert!(thin["fetches_per_query_error"].is_null() && thin["sample_share"].is_null());
    let table = folder.run("pm-cachesim --cache 16K,full,128,lru w.pmt").ok();
    assert!(table.text().contains('±') && table.text().contains("60 windows"), "{}", table.text());
}

#[test]
fn a_window_of_all_is_the_whole() {
    // Every batch a window that begins with an empty cache: without a cache to fill, nothing is lost.
    let folder = folder();
    folder.run(&format!("pm-queries {SIZE} --only-tiles 24 -o rows.pmq")).ok();
    folder.run("pm-gather map.pmp rows.pmq -o rows.pmt").ok();
    let rows = rows(&folder, "pm-cachesim --cache none --format json whole.pmt rows.pmt");
    for name in ["queries", "reads", "raw_bytes", "accesses", "fetches", "bytes_fetched", "reads_per_query"] {
        assert_eq!(rows[0][name], rows[1][name], "{name}");
    }
}

#[test]
fn what_cannot_be_estimated_is_refused_by_name() {
    let folder = folder();
    for (options, says) in [
        ("--curve", "--curve"),
        ("--shards 0.5", "--shards"),
        ("--lanes 1,4", "--lanes"),
        ("--cache 4K,full,128,lru --misses x.pmt", "--misses"),
        ("--policies fifo", "choose lru or none"),
        ("--policies lru,min", "choose lru or none"),
    ] {
        let outcome = folder.run(&format!("pm-cachesim {options} w.pmt"));
        let one = outcome.fails(2);
        assert!(one.contains(says) && one.contains("sampled in windows"), "{one}");
    }
    assert!(!folder.names().contains(&"x.pmt".to_owned()));
}

#[test]
fn samples_are_put_together_until_the_interval_is_as_narrow_as_asked() {
    let folder = folder();
    let line = format!(
        "pm-sweep until --pilot 20 --window 20 --warm-up 30 --queries '{SIZE}' \
         --gather map.pmp --cachesim '--cache 16K,full,128,lru'"
    );
    let row = |options: &str| {
        let outcome = folder.sh(&format!("{line} {options} --quiet > row.csv"));
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        let text = String::from_utf8(folder.read("row.csv")).expect("text");
        let (names, values) = text.trim_end().split_once('\n').expect("two lines");
        // Quoted fields hold no number.
        let values = values.split('"').enumerate().map(|(i, part)| if i % 2 == 1 { "text" } else { part });
        let values = values.collect::<String>();
        let fields: std::collections::BTreeMap<String, f64> = names
            .split(',')
            .zip(values.split(','))
            .filter_map(|(name, value)| Some((name.to_owned(), value.parse().ok()?)))
            .collect();
        fields
    };
    let (pilot, tuned) = (row(""), row("--until 6%"));
    assert_eq!(pilot["windows"], 20.0);
    assert!(tuned["windows"] > 20.0, "{tuned:?}");
    assert!(tuned["fetches_per_query_error"] <= 0.06 * tuned["fetches_per_query"], "{tuned:?}");
    let whole = rows(&folder, "pm-cachesim --cache 16K,full,128,lru --format json whole.pmt");
    let off = tuned["fetches_per_query"] - number(&whole[0], "fetches_per_query");
    assert!(off.abs() < 3.0 * tuned["fetches_per_query_error"], "{off} {tuned:?}");
    // What is put together of one sample is that sample.
    folder.sh("pm-queries --size 32x24 --gathers 9 --only-tiles 20 --sample-seed 100 --window 20 --warm-up 30 -q | \
               pm-gather map.pmp -q -o pilot.pmt");
    let own = &rows(&folder, "pm-cachesim --cache 16K,full,128,lru --format json pilot.pmt")[0];
    for name in ["fetches_per_query", "fetches_per_query_error", "fetches", "reads_per_query_error", "sample_share"] {
        assert!((pilot[name] / number(own, name) - 1.0).abs() < 1e-14, "{name}: {} {}", pilot[name], own[name]);
    }
    let outcome = folder.sh(&format!("{line} --until lots"));
    assert!(outcome.code == 2 && outcome.stderr.contains("such as 1%"), "{}", outcome.stderr);
    // A program that fails has its say, and its exit code is kept.
    let outcome = folder.sh(&format!("{} --quiet", line.replace("--gather map.pmp", "--gather none.pmp")));
    assert!(outcome.code == 1 && outcome.stderr.contains("pm-gather failed"), "{}", outcome.stderr);
    let outcome = folder.sh(&format!("{line} --quiet --reorder nothing"));
    assert!(outcome.code == 2 && outcome.stderr.contains("pm-reorder failed"), "{}", outcome.stderr);
    assert!(outcome.stdout.is_empty());
    // On the way it says how far it is, and at its end why it stops.
    let outcome = folder.sh(&format!("{line} --until 0.001% --most 30"));
    assert!(outcome.code == 0 && outcome.stderr.contains("pm-sweep: 30 windows, "), "{}", outcome.stderr);
    let tight = folder.sh(&format!("{} --until 0.001% --warm-up 0", line.replace("--warm-up 30", "")));
    assert!(tight.code == 0 && tight.stderr.contains("longer --warm-up"), "{}", tight.stderr);
}

#[test]
fn every_column_of_a_sample_is_known_to_whoever_puts_samples_together() {
    let folder = folder();
    let csv = folder.run("pm-cachesim --cache 16K,full,128,lru --format csv w.pmt").ok();
    let names: Vec<&str> = csv.text().lines().next().expect("names").split(',').collect();
    let of_regions = |name: &&str| ["fetches_kd_nodes", "fetches_kd_nodes_error"].contains(name);
    let (regions, plain): (Vec<&str>, Vec<&str>) = names.iter().partition(|name| of_regions(name));
    assert_eq!(regions.len(), 2, "{names:?}");
    assert_eq!(plain, pm_sweep::until::columns().collect::<Vec<_>>(), "left: pm-cachesim, right: pm-sweep");
}
