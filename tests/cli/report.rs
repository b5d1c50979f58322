//! Table, CSV and JSON say the same.

use crate::support::Folder;
use serde_json::Value;

/// Fields of a line of CSV, RFC 4180, without line breaks in fields.
fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut quoted) = (vec![String::new()], false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        let field = fields.last_mut().expect("at least one");
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                field.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            _ => field.push(letter),
        }
    }
    assert!(!quoted, "an open quote: {line}");
    fields
}

#[test]
fn all_formats_have_the_same_values() {
    let folder = Folder::with_streams();
    folder.run("pm-gather map.pmp q.pmq -o t.pmt").ok();
    folder.run("pm-reorder hilbert --per batch q.pmq -o h.pmq").ok();
    folder.run("pm-gather map.pmp h.pmq -o th.pmt").ok();
    // A trace of no searches has no ratios.
    let blank = folder.sh("pm-queries --size 2x2 --gathers 1 --eye 0,0,9 --look-at 0,0,99 -q -o none.pmq");
    assert_eq!(blank.code, 0, "{}", blank.stderr);
    folder.run("pm-gather map.pmp none.pmq -o none.pmt").ok();

    let print = |format: &str| {
        let line = format!("pm-cachesim --sizes 4K,128K --lines 64,128 t.pmt th.pmt none.pmt --format {format}");
        folder.run(&line).ok().text().to_owned()
    };
    let csv: Vec<Vec<String>> = print("csv").lines().map(fields).collect();
    assert_eq!(csv.len(), 1 + 3 * 4);
    assert!(csv.iter().all(|row| row.len() == csv[0].len()));

    // Each row tells how its trace came, as one line for a shell.
    let history = csv[0].iter().position(|name| name == "history").expect("a column");
    for (row, trace) in [(1, "t.pmt"), (5, "th.pmt"), (9, "none.pmt")] {
        let told = folder.run(&format!("pm-view --history {trace}")).ok();
        assert_eq!(csv[row][history], told.text().trim_end().replace('\n', "; "), "{trace}");
        assert!(csv[row][history].contains("pm-gather map.pmp"), "{}", csv[row][history]);
    }

    let json: Value = serde_json::from_str(&print("json")).expect("JSON");
    assert_eq!(json["schema"], 1);
    assert_eq!(json["columns"], Value::from(csv[0].clone()));
    let rows = json["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), csv.len() - 1);
    let mut ratios_missing = 0;
    for (row, line) in rows.iter().zip(&csv[1..]) {
        assert_eq!(row.as_object().expect("an object").len(), csv[0].len());
        for (name, text) in csv[0].iter().zip(line) {
            match &row[name] {
                Value::String(word) => assert_eq!(word, text, "{name}"),
                Value::Number(number) if number.is_u64() => assert_eq!(number.to_string(), *text, "{name}"),
                Value::Number(number) => {
                    // serde_json reads to the last bit but one.
                    let (json, csv) = (number.as_f64().unwrap(), text.parse::<f64>().unwrap());
                    assert!((json - csv).abs() <= 1e-15 * csv.abs(), "{name}: {json} {csv}");
                }
                Value::Null => {
                    assert_eq!(text, "", "{name}");
                    ratios_missing += 1;
                }
                other => panic!("{name}: {other}"),
            }
        }
    }
    // Four ratios per query, page switches per fetch, and four lines per search and per batch; and what is known in full
    // has no degrees of freedom.
    assert_eq!(ratios_missing, 4 * 13 + 12, "ratios of no queries, in four caches");

    // The table is for reading: fewer columns, two spaces or more between them, long names in two lines, ratios to five
    // digits.
    // Traces of one order are told apart by their names.
    let shown = [
        "trace",
        "order",
        "cache",
        "queries",
        "fetches",
        "bytes_fetched",
        "reads_per_query",
        "fetches_per_query",
        "fetches_per_block",
    ];
    let table = print("table");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), csv.len() + 1);
    let head: Vec<String> = lines[..2].join(" ").split_whitespace().map(str::to_owned).collect();
    let expected =
        "reads fetches fetches trace order cache queries fetches bytes_fetched per_query per_query per_block";
    assert_eq!(head.join(" "), expected);
    let places: Vec<usize> = shown.map(|name| csv[0].iter().position(|known| known == name).expect(name)).to_vec();
    let csv: Vec<Vec<&String>> = csv.iter().map(|row| places.iter().map(|&at| &row[at]).collect()).collect();
    for (line, row) in lines[2..].iter().zip(&csv[1..]) {
        let cells: Vec<&str> = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect();
        assert_eq!(cells.len(), row.len(), "{line}");
        for (cell, text) in cells.iter().zip(row) {
            let exact = text.parse::<f64>().ok().filter(|_| text.contains('.'));
            match exact {
                Some(x) => assert!((cell.parse::<f64>().unwrap() - x).abs() <= 6e-5 * x.abs(), "{cell} for {text}"),
                None if text.is_empty() => assert_eq!(*cell, "-"),
                None => assert_eq!(cell, text),
            }
        }
    }
    assert_eq!(
        print("table"),
        folder.run("pm-cachesim --sizes 4K,128K --lines 64,128 t.pmt th.pmt none.pmt").ok().text()
    );
}
