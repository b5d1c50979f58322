//! Histories read as what one could type.

use super::*;

fn step(program: &str, arguments: &[&str]) -> Step {
    Step {
        program: program.into(),
        version: "0".into(),
        arguments: arguments.iter().map(|&a| a.into()).collect(),
        seed: None,
        input: None,
        inputs: vec![],
    }
}

#[test]
fn reads_as_the_pipe_one_could_type_again() {
    let mut gather = step("pm-gather", &["map.pmp"]);
    gather.inputs.push(("map.pmp".into(), vec![step("pm-photons", &["-n", "100"])]));
    let history = [step("pm-queries", &["my scene.obj"]), step("pm-reorder", &["hilbert"]), gather];
    assert_eq!(
        as_commands(&history),
        "pm-photons -n 100 > map.pmp\npm-queries 'my scene.obj' | pm-reorder hilbert | pm-gather map.pmp\n"
    );
}

#[test]
fn streams_kept_in_files_are_made_before_they_are_read() {
    let mut reorder = step("pm-reorder", &["hilbert", "q.pmq"]);
    reorder.input = Some("q.pmq".into());
    let history = [step("pm-queries", &[]), reorder, step("pm-gather", &["map.pmp"])];
    assert_eq!(as_commands(&history), "pm-queries > q.pmq\npm-reorder hilbert q.pmq | pm-gather map.pmp\n");
}

#[test]
fn another_stream_read_from_a_pipe_is_piped_again() {
    let mut gather = step("pm-gather", &["-", "q.pmq"]);
    gather.input = Some("q.pmq".into());
    gather.inputs.push(("-".into(), vec![step("pm-photons", &[])]));
    let history = [step("pm-queries", &[]), gather];
    assert_eq!(as_commands(&history), "pm-queries > q.pmq\npm-photons | pm-gather - q.pmq\n");
}

#[test]
fn shell_metacharacters_are_quoted() {
    assert_eq!(quoted("a b"), "'a b'");
    assert_eq!(quoted("it's"), "'it'\\''s'");
    assert_eq!(quoted(""), "''");
    assert_eq!(quoted("$(rm)"), "'$(rm)'");
}
