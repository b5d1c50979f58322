//! Points are of the whole picture, the earlier table's go first, and what is beaten is not best.

use super::*;
use crate::derivation::derived;

const HEAD: &str = "n,order,tile,store,record,share,found,cache_bytes,order_bytes_on_chip,fetches,compulsory,blocks,line_bytes,\
    bytes_written_back,query_bytes,result_bytes\n";

fn lines(tables: &[&str]) -> Vec<String> {
    let tables: Vec<String> = tables.iter().map(|rows| format!("{HEAD}{rows}")).collect();
    let tables: Vec<(&str, &str)> = tables.iter().map(|text| ("t.csv", &**text)).collect();
    let text = derived(&FRONTIER, &tables, &[]).unwrap().text;
    text.lines().skip(1).map(str::to_owned).collect()
}

#[test]
fn what_is_thinned_counts_for_the_whole_but_first_touches() {
    let of = |row: &str| lines(&[row])[0].clone();
    // 90 of 100 fetches are again, times 4; first touches are 40, of which there can be 25.
    let thinned = of("9,hilbert,,1M,compact,1/4,thinned,1024,100,100,10,25,128,8,5,6\n");
    let map = (90 * 4 + 25) * 128 + 8 * 4;
    let rest = format!("17508,{map},20,24,{},yes", map + 44);
    assert_eq!(thinned, format!("9,hilbert,compact,hilbert-1M,1/4,thinned,1024,100,{rest}"));
}

#[test]
fn the_least_cache_that_holds_the_map_is_kept_and_stands_beside_both_records() {
    let row = |cache: u32, fetches: u32| format!("9,scanline,,,full,1,full,{cache},0,{fetches},10,10,1,0,0,0\n");
    let found = lines(&[&(row(1, 20) + &row(2, 10) + &row(4, 10))]);
    let told: Vec<String> =
        found.iter().map(|line| line.split(',').skip(1).take(2).collect::<Vec<_>>().join(" ")).collect();
    let both = |series: &str| [format!("{series} full"), format!("{series} compact")];
    assert_eq!(told, [both("scanline"), both("scanline"), both(HOLDS_THE_MAP)].concat());
}

#[test]
fn what_is_there_in_full_is_not_taken_from_samples() {
    let row =
        |order: &str, store: &str, found: &str| format!("9,{order},,{store},full,1,{found},1,0,20,10,10,1,0,0,0\n");
    let full = row("cells", "1M", "full");
    let later = row("cells", "1M", "sampled")
        + &row("cells", "2M", "sampled")
        + &row("cells", "2M", "thinned")
        + &row("leaf", "1M", "thinned");
    let told: Vec<String> = lines(&[&full, &later])
        .iter()
        .map(|line| line.split(',').nth(3).unwrap().to_owned() + " " + line.split(',').nth(5).unwrap())
        .collect();
    assert_eq!(told, ["cells-1M full", "cells-2M sampled", "leaf-1M thinned"]);
}

#[test]
fn what_is_beaten_by_its_like_is_not_best() {
    let row =
        |order: &str, cache: u32, fetches: u32| format!("9,{order},,,full,1,full,{cache},0,{fetches},10,10,1,0,0,0\n");
    // More on chip and as much traffic; the other order is no match.
    let rows = row("leaf", 1, 20) + &row("leaf", 2, 20) + &row("leaf", 4, 19) + &row("cells", 2, 99);
    let best: Vec<bool> = lines(&[&rows]).iter().map(|line| line.ends_with(",yes")).collect();
    assert_eq!(best, [true, false, true, true]);
}

#[test]
fn what_is_no_number_is_said_with_its_line() {
    let text = format!("{HEAD}9,leaf,,,full,1,full,1,0,x,10,10,1,0,0,0\n");
    let error = derived(&FRONTIER, &[("t.csv", &text)], &[]).unwrap_err().to_string();
    assert_eq!(error, "t.csv, line 2: `x` in column fetches is not a number");
}
