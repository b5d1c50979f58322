//! Arguments as typed, without those that cannot change a record.

use clap::Command;
use std::ffi::OsString;

/// Options that leave no trace in a stream: how the work is done, not what it is.
const PASSING: [&str; 6] = ["threads", "quiet", "verbose", "output", "memory", "temporary"];

/// What was typed, minus the passing options and their values.
pub(super) fn lasting_arguments(command: &Command, raw: &[OsString]) -> Vec<String> {
    let find = |test: &dyn Fn(&clap::Arg) -> bool| command.get_arguments().find(|argument| test(argument));
    let takes_value = |argument: &clap::Arg| argument.get_action().takes_values();
    let passes = |argument: &clap::Arg| PASSING.contains(&argument.get_id().as_str());

    let mut kept = vec![];
    let mut words = raw.iter().map(|word| word.to_string_lossy().into_owned());
    while let Some(word) = words.next() {
        if word == "--" {
            kept.push(word);
            kept.extend(words);
            break;
        }
        if let Some(long) = word.strip_prefix("--") {
            let (name, value) = long.split_once('=').map_or((long, None), |(name, value)| (name, Some(value)));
            let argument = find(&|argument| argument.get_long() == Some(name));
            let next = argument.filter(|a| takes_value(a) && value.is_none()).and_then(|_| words.next());
            if !argument.is_some_and(passes) {
                kept.push(word);
                kept.extend(next);
            }
        } else if let Some(shorts) = word.strip_prefix('-').filter(|shorts| !shorts.is_empty()) {
            // -qt4 is -q -t 4: flags, then perhaps an option with the rest of the word, or the next, for its value.
            let mut flags = String::from("-");
            for (at, letter) in shorts.char_indices() {
                let argument = find(&|argument| argument.get_short() == Some(letter));
                if argument.is_some_and(takes_value) {
                    let rest = &shorts[at + letter.len_utf8()..];
                    let next = if rest.is_empty() { words.next() } else { None };
                    if !argument.is_some_and(passes) {
                        flags.push(letter);
                        flags.push_str(rest);
                        kept.push(std::mem::replace(&mut flags, "-".into()));
                        kept.extend(next);
                    }
                    break;
                }
                if !argument.is_some_and(passes) {
                    flags.push(letter);
                }
            }
            if flags != "-" {
                kept.push(flags);
            }
        } else {
            kept.push(word);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{Arg, ArgAction};

    fn kept(line: &str) -> String {
        let command = Command::new("x")
            .arg(Arg::new("threads").short('t').long("threads"))
            .arg(Arg::new("output").short('o').long("output"))
            .arg(Arg::new("quiet").short('q').long("quiet").action(ArgAction::SetTrue))
            .arg(Arg::new("number").short('n').long("number"))
            .arg(Arg::new("all").short('a').action(ArgAction::SetTrue));
        let raw: Vec<OsString> = line.split_whitespace().map(OsString::from).collect();
        lasting_arguments(&command, &raw).join(" ")
    }

    #[test]
    fn options_that_cannot_change_a_record_are_left_out() {
        assert_eq!(kept("scene.obj -n 5 -t 4 -o out -q"), "scene.obj -n 5");
        assert_eq!(kept("--threads=4 --number=5 --output out in"), "--number=5 in");
        assert_eq!(kept("-qt4 -aqn5 x"), "-an5 x");
        assert_eq!(kept("-qo out -a -"), "-a -");
        assert_eq!(kept("-qan 5 -t 2"), "-an 5");
        assert_eq!(kept("-q -- -q -t"), "-- -q -t");
    }
}
