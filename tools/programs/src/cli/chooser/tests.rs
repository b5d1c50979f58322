//! Do the words and options of a registry become those of a command line, and is what does nothing refused?

use super::*;
use crate::cli::{Outcome, Program};
use pm_registry::words_of;

pm_registry::choices! {
    /// Metals.
    #[derive(Debug)]
    enum Metal {
        /// Rusts
        Iron = "iron",
        /// Does not
        Brass = "brass" | "messing",
    }
}

const EDGE: Parameter = Parameter::new("edge", Domain::Length, "length of the edge").hidden();
const METAL: Parameter = Parameter::new("metal", Domain::Word(words_of::<Metal>), "what it is made of").or("iron");

pm_registry::registered! {
    /// Cuts bread
    struct Knife = "knife" with [EDGE, METAL];
}

pm_registry::registered! {
    /// Cuts wood
    struct Saw = "saw" | "fret" with [EDGE, Parameter::new("dull", Domain::Flag, "not sharpened")];
}

trait Blade: Registered + Sync {}
impl Blade for Knife {}
impl Blade for Saw {}

/// What a program that takes a blade says when it is asked like this, and the blade.
fn ask(by_option: bool, line: &str) -> (Outcome, Option<Chosen<dyn Blade>>) {
    let blades: Registry<dyn Blade> = Registry::new("blade", &[&Knife, &Saw]);
    let argument = Arg::new("blade").value_name("BLADE").help("With what to cut");
    let chooser = match by_option {
        true => Chooser::option(&blades, argument.long("blade")),
        false => Chooser::positional(&blades, argument),
    };
    let command = chooser.add_parameters(chooser.add_word(Command::new("cut")));
    let mut chosen = None;
    let outcome =
        Program::new("cut", command, move |matches| chooser.read(matches)).run(line.split_whitespace(), |it, _| {
            chosen = Some(it);
            Ok(())
        });
    (outcome, chosen)
}

#[test]
fn what_is_typed_reaches_the_entry() {
    let chosen = |by_option, line: &str| ask(by_option, line).1.unwrap_or_else(|| panic!("{line}"));
    let knife = chosen(true, "");
    assert_eq!((knife.entry.word(), knife.values.length_if_any("edge")), ("knife", None));
    assert!(matches!(knife.values.choice("metal"), Metal::Iron));
    let knife = chosen(false, "knife --metal messing --edge 0.5");
    assert!(matches!(knife.values.choice("metal"), Metal::Brass) && knife.values.length_if_any("edge") == Some(0.5));
    let saw = chosen(true, "--blade fret --dull");
    assert!(saw.entry.word() == "saw" && saw.values.flag("dull") && !chosen(true, "--blade saw").values.flag("dull"));
}

#[test]
fn what_the_entry_does_not_take_is_refused() {
    for (by_option, line, said) in [
        (true, "--dull", "--dull is for --blade saw, not for knife: leave --dull out"),
        (false, "knife --dull", "--dull is for saw, not for knife: leave --dull out"),
        // Even the default.
        (false, "saw --metal iron", "--metal is for knife, not for saw: leave --metal out"),
        (false, "knife --edge 0", "invalid value '0' for '--edge <X>': a length above 0 is expected, in scene units"),
        (false, "knife --metal tin", "invalid value 'tin' for '--metal <WORD>'"),
        (true, "--blade sew", "invalid value 'sew' for '--blade <BLADE>'"),
    ] {
        let (outcome, chosen) = ask(by_option, line);
        assert!(
            outcome.code() == 2 && chosen.is_none() && outcome.said().starts_with(said),
            "{line}: {}",
            outcome.said()
        );
    }
    assert!(ask(true, "--blade sew").0.said().contains("[possible values: knife, saw]"));
    assert!(ask(false, "knife --metal tin").0.said().contains("[possible values: iron, brass]"));
}

#[test]
fn the_help_says_which_entries_take_what() {
    let help = |line| ask(false, line).0.help().expect("a help");
    let long = help("--help");
    for said in
        ["- knife: Cuts bread", "knife, saw: length of the edge", "knife: what it is made of", "- brass: Does not"]
    {
        assert!(long.contains(said), "{said}:\n{long}");
    }
    let short = help("-h");
    assert!(short.contains("saw: not sharpened") && !short.contains("edge"), "{short}");
}

#[test]
#[should_panic(expected = "--edge is an option of the program")]
fn names_of_the_program_are_not_taken() {
    let blades: Registry<dyn Blade> = Registry::new("blade", &[&Saw]);
    let chooser = Chooser::positional(&blades, Arg::new("blade"));
    let _ = chooser.add_parameters(Command::new("cut").arg(Arg::new("edge").long("edge")));
}

#[test]
fn a_choice_that_is_left_goes_to_the_first_that_takes_what_is_said() {
    let blades: Registry<dyn Blade> = Registry::new("blade", &[&Knife, &Saw]);
    let chooser = Chooser::automatic(&blades, Arg::new("blade").long("blade"), "what serves");
    let ask = |line: &str| {
        let command = chooser.add_parameters(chooser.add_word(Command::new("cut")));
        let matches = command.try_get_matches_from(["cut"].into_iter().chain(line.split_whitespace()));
        let chosen = chooser.read_or_choose(&matches.expect("words that are known"), &[&Saw, &Knife]);
        chosen.map(|chosen| chosen.entry.word()).map_err(|error| error.to_string())
    };
    for (line, word) in [
        ("", "saw"),
        ("--blade auto", "saw"),
        ("--metal brass", "knife"),
        ("--blade knife", "knife"),
        ("--blade fret", "saw"),
        ("--edge 1", "saw"),
    ] {
        assert_eq!(ask(line), Ok(word), "{line}");
    }
    assert!(ask("--dull --metal brass").unwrap_err().contains("--dull is for --blade saw, not for knife"));
    assert!(ask("--blade knife --dull").unwrap_err().contains("--dull is for --blade saw, not for knife"));
}
