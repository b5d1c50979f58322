//! Do runs on disk come back sorted, and are errors told?

use super::*;
use bytemuck::Zeroable as _;
use pm_random::mix;

fn query(pixel: u32) -> Query {
    Query { pixel, ..Query::zeroed() }
}

#[test]
fn many_small_runs_come_back_sorted_and_stable() {
    // More than a level holds twice over, so that runs of two levels are merged.
    let mut runs = Runs::new(std::env::temp_dir(), 1 << 16);
    let all: Vec<(u32, Query)> = (0..3000u32).map(|i| ((mix(i.into()) % 50) as u32, query(i))).collect();
    for run in all.chunks(10) {
        let mut run = run.to_vec();
        run.sort_by_key(|&(key, _)| key);
        runs.add(run.into_iter()).unwrap();
    }
    assert!(runs.runs.len() < FAN);
    let mut expected = all;
    expected.sort_by_key(|&(key, _)| key);
    let mut got = vec![];
    runs.drain(|key, query| {
        got.push((key, query));
        Ok(())
    })
    .unwrap();
    assert!(got == expected);
    assert!(runs.is_empty());
}

#[test]
fn where_no_file_can_be_the_message_says_what_to_do() {
    let mut runs = Runs::new("/nosuch/folder".into(), 1 << 16);
    let message = runs.add([(0, query(0))].into_iter()).unwrap_err().to_string();
    assert!(message.starts_with("cannot make a temporary file in /nosuch/folder: "), "{message}");
    assert!(message.ends_with("set TMPDIR to a folder with room, or give more --memory"), "{message}");
}

#[test]
fn an_error_of_the_receiver_is_its_own() {
    let mut runs = Runs::new(std::env::temp_dir(), 1 << 16);
    runs.add([(0, query(0)), (1, query(1))].into_iter()).unwrap();
    let outcome = runs.drain(|_, _| Err(pm_formats::Error::Invalid("enough".into())));
    assert_eq!(outcome.unwrap_err().to_string(), "cannot be written to a stream: enough");
}
