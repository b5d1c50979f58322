//! Does the simulator issue each transaction that is written once, whatever room its queue has?

use super::*;
use pm_formats::trace::AccessKind;
use pm_random::Random;

/// A stream of characters as C++ has it: a number or a word that ends with the input sets the mark of the end, and where
/// nothing follows a read fails and changes nothing.
struct Stream<'a> {
    text: &'a [u8],
    at_end: bool,
}

impl Stream<'_> {
    fn word(&mut self) -> Option<String> {
        let begin = self.text.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(self.text.len());
        let rest = &self.text[begin..];
        let end = rest.iter().position(u8::is_ascii_whitespace);
        self.at_end |= end.is_none();
        let (word, rest) = rest.split_at(end.unwrap_or(rest.len()));
        self.text = rest;
        (!word.is_empty()).then(|| String::from_utf8(word.to_vec()).unwrap())
    }
}

/// The addresses that the simulator issues of a trace (`TraceBasedCPU::ClockTick`), where its queue has room with this
/// probability in each cycle.
fn issued(trace: &[u8], room: f64, random: &mut Random) -> Vec<String> {
    let mut stream = Stream { text: trace, at_end: false };
    let (mut address, mut cycle, mut next, mut issued) = (String::new(), 0, true, vec![]);
    for clock in 0..10_000u64 {
        if stream.at_end {
            break;
        }
        if next {
            next = false;
            if let (Some(read), Some(_), Some(added)) = (stream.word(), stream.word(), stream.word()) {
                (address, cycle) = (read, added.parse().unwrap());
            }
        }
        if cycle <= clock {
            next = f64::from(random.unit()) < room;
            if next {
                issued.push(address.clone());
            }
        }
    }
    issued
}

fn written(transactions: u64) -> Vec<u8> {
    let mut writer = Writer { transactions: 0 };
    let mut output = vec![];
    for number in 0..transactions {
        let kind = if number % 3 == 1 { AccessKind::Write } else { AccessKind::Read };
        writer.write(&Piece { kind, address: 64 * number, len: 64, search: 0 }, &mut output).unwrap();
    }
    writer.finish(&mut output).unwrap();
    output
}

#[test]
fn the_last_line_is_one_that_is_never_issued_and_has_no_end() {
    assert_eq!(written(2), b"0x0 READ 0\n0x40 WRITE 1\n0x0 READ 9223372036854775807");
    assert_eq!(written(0), b"", "a trace without accesses is empty");
}

#[test]
fn each_transaction_is_issued_once() {
    let mut random = Random::new(&[5]);
    let mut otherwise = std::collections::BTreeSet::new();
    for transactions in [1, 2, 50] {
        let trace = written(transactions);
        let expected: Vec<String> = (0..transactions).map(|number| format!("{:#x}", 64 * number)).collect();
        for room in [1.0, 0.5, 0.1] {
            for _ in 0..20 {
                assert_eq!(issued(&trace, room, &mut random), expected, "room {room}");
                // Lines alone, with an end of the last one and without.
                let lines = &trace[..=trace.iter().rposition(|&byte| byte == b'\n').unwrap()];
                for lines in [lines, &lines[..lines.len() - 1]] {
                    let number = issued(lines, room, &mut random).len();
                    otherwise.insert(number as i64 - transactions as i64);
                }
            }
        }
    }
    assert_eq!(otherwise.into_iter().collect::<Vec<_>>(), [-1, 0, 1], "one too few, right, or one too many");
}
