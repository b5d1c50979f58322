//! A generative order added from outside: the file `columns.rs`, and the line that names it here.

#[path = "generative_order/columns.rs"]
mod columns;

use columns::Columns;
use pm_formats::{Query, RecordReader};
use pm_orders::{GenerativeOrder, generative_orders, trial};
use pm_programs::cli::Outcome;
use pm_programs::queries;
use pm_registry::Registry;
use std::path::PathBuf;

fn orders() -> Registry<dyn GenerativeOrder> {
    generative_orders().with(&Columns)
}

fn ask(line: &str) -> Outcome {
    queries::program(&orders()).run(line.split_whitespace(), queries::run)
}

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// Pixels of the queries in their order, the batches they are of, and the digest of all.
fn queries(name: &str, options: &str) -> (Vec<u32>, u64, String) {
    let path = file(name);
    let line = format!("--size 6x4 --gathers 3 {options} -o {}", path.display());
    let outcome = ask(&line);
    assert_eq!(outcome.code(), 0, "{line}: {}", outcome.said());
    let mut reader = RecordReader::<Query, _>::new(std::fs::File::open(path).unwrap()).unwrap();
    let (mut pixels, mut batches) = (vec![], 0);
    while let Some((meta, block)) = reader.next_block().unwrap() {
        pixels.extend(block.iter().map(|query| query.pixel));
        batches = batches.max(meta.batch + 1);
    }
    (pixels, batches, reader.tally().digest.to_string())
}

#[test]
fn the_program_casts_the_same_queries_in_the_new_order() {
    let (pixels, batches, digest) = queries("columns.pmq", "--order columns --wide 4");
    let (rows, _, same) = queries("rows.pmq", "");
    assert_eq!((batches, &digest), (2, &same));
    assert_ne!(pixels, rows);
    assert!(pixels.is_sorted_by_key(|pixel| (pixel % 6 / 4, pixel % 6, pixel / 6)), "{pixels:?}");
    // Windows of it are parts of it.
    let (window, ..) = queries("window.pmq", "--order columns --wide 4 --only-tiles 1 --window 9 --warm-up 0");
    assert!(!window.is_empty() && pixels.windows(window.len()).any(|part| part == window), "{window:?}");
}

#[test]
fn its_word_and_option_are_those_of_the_command_line() {
    let help = ask("--help").help().unwrap();
    assert!(help.contains("- columns:") && help.contains("Column by column"), "{help}");
    assert!(help.contains("columns: columns of a batch"), "{help}");
    assert!(ask("--order spiral").said().contains("scanline, tiled, direction-binned, columns"));
    assert!(ask("--wide 3").said().contains("--wide is for --order columns, not for scanline"));
    assert!(
        orders().table().contains("| `columns` | Column by column, some at a time; these are a batch | `--wide` |")
    );
}

#[test]
fn what_every_order_is_asked_is_asked_of_it() {
    trial::generative(&orders()).unwrap();
}
