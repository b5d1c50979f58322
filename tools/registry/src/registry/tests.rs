//! Are words and parameters those of the entries, and is what nobody takes refused?

use super::*;
use crate::Domain;

struct Tool(&'static str);

impl Registered for Tool {
    fn word(&self) -> &'static str {
        self.0
    }
    fn help(&self) -> &'static str {
        "Does it"
    }
    fn aliases(&self) -> &'static [&'static str] {
        if self.0 == "saw" { &["Säge"] } else { &[] }
    }
}

#[test]
fn a_word_finds_its_thing_and_another_is_told_of_all() {
    let tools = Registry::new("tool", &[&Tool("saw"), &Tool("axe")]);
    assert_eq!(tools.find("Säge").map(|tool| tool.0), Ok("saw"));
    let said = tools.find("sew").err().map(|error| error.to_string());
    assert_eq!(said.as_deref(), Some("`sew` is no tool: there are saw, axe"));
    assert_eq!(tools.with(&Tool("file")).words(), ["saw", "axe", "file"]);
}

#[test]
fn the_table_has_a_row_for_each() {
    let tools = Registry::new("tool", &[&Tool("saw")]);
    assert_eq!(tools.table(), "| tool | |\n| --- | --- |\n| `saw` | Does it |\n");
}

#[test]
#[should_panic(expected = "the word Säge stands for two tools")]
fn no_word_stands_for_two() {
    let _ = Registry::new("tool", &[&Tool("Säge"), &Tool("saw")]);
}

#[derive(Debug)]
struct Blade(&'static str, &'static [Parameter]);

impl Registered for Blade {
    fn word(&self) -> &'static str {
        self.0
    }
    fn help(&self) -> &'static str {
        "Cuts"
    }
    fn parameters(&self) -> &'static [Parameter] {
        self.1
    }
}

const EDGE: Parameter = Parameter::new("edge", Domain::Length, "length of the edge");
const DULL: Parameter = Parameter::new("dull", Domain::Flag, "not sharpened");

fn blades() -> Registry<Blade> {
    const TEETH: Parameter = Parameter::new("teeth", Domain::count(1, 99), "teeth an inch");
    static KNIFE: Blade = Blade("knife", &[EDGE, DULL]);
    static SAW: Blade = Blade("saw", &[EDGE, TEETH.or("7")]);
    static RASP: Blade =
        Blade("rasp", &[TEETH.or("40"), Parameter::new("grain", Domain::Seed, "for its marks").needed()]);
    const COMMON: &[Parameter] = &[Parameter::new("handle", Domain::Share, "share of the handle").or("0.5")];
    Registry::new("blade", &[&KNIFE, &SAW, &RASP]).with_common(COMMON)
}

#[test]
fn a_parameter_is_listed_once_with_the_entries_that_take_it() {
    let all = blades().parameters();
    let helps: Vec<(&str, String)> = all.iter().map(|shared| (shared.parameter().name, shared.help())).collect();
    let expected = [
        ("handle", "Share of the handle"),
        ("edge", "knife, saw: length of the edge"),
        ("dull", "knife: not sharpened"),
        ("teeth", "saw: teeth an inch [default: 7]; rasp: teeth an inch [default: 40]"),
        ("grain", "rasp: for its marks"),
    ];
    assert_eq!(helps, expected.map(|(name, help)| (name, help.to_owned())));
    assert_eq!(all.iter().map(Shared::default).collect::<Vec<_>>(), [Some("0.5"), None, None, None, None]);
}

#[test]
fn values_are_what_was_given_and_else_the_default() {
    let values = blades().choose("saw --edge 2.5").unwrap().values;
    assert_eq!(
        (values.length_if_any("edge"), values.count::<u8>("teeth"), values.share("handle")),
        (Some(2.5), 7, 0.5)
    );
    assert_eq!([values.is_given("edge"), values.is_given("teeth")], [true, false]);
    let values = blades().choose("knife --dull --handle 1").unwrap().values;
    assert!(values.flag("dull") && values.length_if_any("edge").is_none() && values.seed().is_none());
    assert_eq!(blades().choose("rasp --grain 5").unwrap().values.seed(), Some(5));
}

#[test]
fn what_an_entry_does_not_take_or_lacks_is_refused() {
    for (line, said) in [
        ("knife --teeth 3", "--teeth is for saw, rasp, not for knife: leave --teeth out"),
        ("knife --tooth 3", "knife takes no --tooth: leave --tooth out"),
        ("saw --teeth 0", "--teeth 0: a whole number from 1 to 99 is expected"),
        ("saw --teeth", "`--teeth` is no option, or its value is missing"),
        ("saw 3", "`3` is no option, or its value is missing"),
        ("saw --teeth 3 --teeth 4", "--teeth is given twice"),
        ("rasp", "rasp needs --grain: give --grain N"),
        ("sew --teeth 3", "`sew` is no blade: there are knife, saw, rasp"),
    ] {
        assert_eq!(blades().choose(line).err().map(|error| error.to_string()).as_deref(), Some(said), "{line}");
    }
}

#[test]
fn the_table_tells_the_options_of_each() {
    let rows: Vec<_> = blades().table().lines().map(str::to_owned).collect();
    assert_eq!(rows[0], "| blade | | options |");
    assert_eq!(rows[3], "| `saw` | Cuts | `--edge`, `--teeth` |");
}

#[test]
#[should_panic(expected = "--edge of axe is another's")]
fn a_name_is_of_one_kind_of_values() {
    static AXE: Blade = Blade("axe", &[Parameter::new("edge", Domain::Flag, "has one")]);
    let _ = blades().with(&AXE);
}
