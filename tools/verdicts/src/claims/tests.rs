//! Claims are judged by our numbers and their intervals, and what is missing is said with its line.

use super::*;
use pm_report::sheet::Sheets;
use std::collections::BTreeMap;

const HEAD: &str = "# Remarks.\nid,section,claim,unit,paper,ours,rule,reason\n";

/// What is derived of claims and two files of results.
fn verdicts(rows: &str, list: bool) -> Result<String, ReportError> {
    let results = Sheets::default();
    results.add("out/s/a.csv", b"ways,n,n_error\n8,10,1\nfull,20,\n")?;
    results.add("out/s/b.csv", b"n,n_error\n100,0.1\n")?;
    let tables = [Table::read("claims.csv", format!("{HEAD}{rows}"))?];
    let settings = if list { [("list".to_owned(), "1".to_owned())].into() } else { BTreeMap::new() };
    Ok(derive(&Asked { tables: &tables, settings: &settings, results: &results })?.text)
}

/// Ours, ratio, verdict and reason of a claim.
fn judged(paper: &str, ours: &str, rule: &str) -> [String; 4] {
    let text = verdicts(&format!("x,1,c,,{paper},\"{ours}\",{rule},\n"), false).unwrap();
    let table = Table::read("verdicts.csv", text).unwrap();
    let row = table.rows().next().unwrap();
    ["ours", "ratio", "verdict", "reason"].map(|name| row.text(name).unwrap().to_owned())
}

#[test]
fn a_limit_within_the_interval_decides_nothing() {
    let eight = "point('s/a', ways=8).n";
    assert_eq!(judged("20", eight, "<= 11.01"), ["10 ± 1", "0.5", "confirmed", ""]);
    let within = "the limit lies within the interval";
    assert_eq!(judged("20", eight, "<= 10.99"), ["10 ± 1", "0.5", "cannot be decided", within]);
    assert_eq!(judged("", eight, "<= 9.5"), ["10 ± 1", "", "cannot be decided", within]);
    assert_eq!(judged("", eight, "<= 8.99"), ["10 ± 1", "", "not confirmed", ""]);
    assert_eq!(judged("0", eight, "9..11"), ["10 ± 1", "", "confirmed", ""]);
    // Both ends are outside, and the value is not.
    assert_eq!(judged("10", eight, "within 1.05")[2], "cannot be decided");
    // In full, and a product whose factors are as far off as each other.
    assert_eq!(judged("", "point('s/a', ways='full').n", ">= 20"), ["20", "", "confirmed", ""]);
    assert_eq!(judged("", &format!("{eight} * {eight}"), ">= 90")[0], "100 ± 14");
    assert_eq!(judged("", &format!("point('s/b').n / {eight} * 1e3"), ">= 90")[0], "1e+04 ± 1e+03");
}

#[test]
fn files_are_told_before_they_are_there() {
    let rows =
        "a,1,c,,,point('s/lost').n / point('s/a').n,>= 1,\nb,1,c,,1,,none,because\nc,1,c,,,point('s/lost').m,>= 1,\n";
    assert_eq!(verdicts(rows, true).unwrap(), "out/s/lost.csv\nout/s/a.csv\n");
}

#[test]
fn what_cannot_be_tested_is_said_with_its_line() {
    let ok = "a,1,c,,1,point('s/b').n,>= 1,\n";
    for (row, hint) in [
        ("x,1,c,,1,point('s/lost').n,>= 1,", "out/s/lost.csv: No such file"),
        ("x,1,c,,1,point('s/b').m,>= 1,", "there is no column `m`"),
        ("x,1,c,,1,point('s/a').n,>= 1,", "out/s/a.csv has 2 rows, and they differ in n"),
        ("x,1,c,,1,point('s/a').n_error,>= 1,", "has 2 rows"),
        ("x,1,c,,1,\"point('s/a', ways='full').n_error\",>= 1,", "is not a number"),
        ("x,1,c,,1,s/b:n,>= 1,", "expected"),
        ("x,1,c,,1,point('s/b').n / 0,>= 1,", "0"),
        ("x,1,c,,1,point('s/b').n,== 1,", "`== 1` is no rule"),
        ("x,1,c,,many,point('s/b').n,>= 1,", "`many` in column paper"),
        ("x,1,c,,1,,none,", "needs a reason"),
    ] {
        let error = verdicts(&format!("{ok}{row}\n"), false).expect_err(row).to_string();
        assert!(error.starts_with("claims.csv, line 4: ") && error.contains(hint), "{row}: {error}");
    }
}
