//! What every format must do that is read.

use super::accesses::{Seen, accesses_in, trace_in};
use crate::traces::{AssumedSize, EntryKind, EntryShape, Reading, Recognition, References, TraceImport};
use pm_formats::trace::AccessKind;
use pm_random::Random;
use pm_registry::Registry;

/// Tries every format that is read: its example says what it should, with every option; a text tells itself where it
/// should, a binary format never; an input that is cut or no input of the format is an error with its place, and never a
/// panic.
///
/// # Panics
/// If one of them does not.
pub fn imports(imports: &Registry<dyn TraceImport>) {
    for import in imports.iter() {
        the_example_says_what_it_should(import, imports);
        it_is_recognised_as_it_says(import, imports);
        a_cut_record_is_an_error(import, imports);
        no_bytes_make_it_panic(import, imports);
    }
}

/// The accesses that the entries of an example are, given how they are read.
fn expected(import: &dyn TraceImport, reading: &Reading) -> Vec<Seen> {
    let assumed = import.assumed_size().unwrap_or(AssumedSize::BYTE);
    let access = |entry: &crate::traces::Reference| {
        let kind = match (entry.kind, reading.references) {
            (EntryKind::Data(kind), References::Data | References::All) => kind,
            (EntryKind::Instruction, References::Instructions | References::All) => AccessKind::Read,
            _ => return None,
        };
        let address = entry.address * reading.address_unit;
        Some(match reading.access_size.or(entry.len) {
            Some(len) => (kind, address, len),
            None if assumed.aligned => {
                (kind, address / u64::from(assumed.bytes) * u64::from(assumed.bytes), assumed.bytes)
            }
            None => (kind, address, assumed.bytes),
        })
    };
    import.example().entries.iter().filter_map(access).collect()
}

fn the_example_says_what_it_should(import: &'static dyn TraceImport, imports: &Registry<dyn TraceImport>) {
    let (word, example) = (import.word(), import.example());
    assert!(example.entries.len() > 1, "{word}: an example of two entries or more is needed");
    let data = example.entries.iter().any(|entry| matches!(entry.kind, EntryKind::Data(_)));
    assert!(data, "{word}: the example tells of no access to data");
    let sizes = example.entries.iter().all(|entry| entry.len.is_some());
    assert!(sizes || import.assumed_size().is_some(), "{word}: what if an entry does not say its size?");
    let plain = Reading::plain().of(import);
    for reading in [
        plain.clone(),
        Reading { access_size: Some(1), ..plain.clone() },
        Reading { references: References::Instructions, ..plain.clone() },
        Reading { references: References::All, ..plain },
    ] {
        let found = accesses_in(example.input, &reading, imports);
        assert_eq!(found, Ok((word, expected(import, &reading))), "{word}: what its example says");
    }
}

fn it_is_recognised_as_it_says(import: &dyn TraceImport, imports: &Registry<dyn TraceImport>) {
    let word = import.word();
    let found = trace_in(import.example().input, &Reading::plain(), imports);
    match (import.shape(), import.recognition()) {
        (EntryShape::Record { .. } | EntryShape::Headed { .. }, Recognition::Signature) => {
            let named = found.map(|trace| trace.format().word());
            assert_eq!(named, Ok(word), "{word}: what its example is taken for");
            the_signature_is_heeded(import, imports);
        }
        (EntryShape::Record { .. } | EntryShape::Headed { .. }, how) => {
            assert_eq!(how, Recognition::ByName, "{word}: a binary format has no first line");
            assert!(found.is_err(), "{word}: a binary format that was not named was guessed");
        }
        (EntryShape::Line, Recognition::ByName | Recognition::Signature) => {
            let named = found.map(|trace| trace.format().word());
            assert_ne!(named, Ok(word), "{word}: recognised, though it has to be named");
        }
        (EntryShape::Line, _) => {
            let named = found.map(|trace| trace.format().word());
            assert_eq!(named, Ok(word), "{word}: what its example is taken for");
        }
    }
}

/// Whatever else the input is said to be, it is refused, and the error says what it is.
fn the_signature_is_heeded(import: &dyn TraceImport, imports: &Registry<dyn TraceImport>) {
    let word = import.word();
    for other in imports.iter().filter(|other| other.word() != word) {
        let found = trace_in(import.example().input, &Reading::plain().of(other), imports).err();
        let expected = format!("--input {}, but the input is {word}: leave --input out", other.word());
        assert_eq!(found, Some(expected), "{word}: given for another");
    }
}

fn a_cut_record_is_an_error(import: &'static dyn TraceImport, imports: &Registry<dyn TraceImport>) {
    let (word, input) = (import.word(), import.example().input);
    let (header, bytes) = match import.shape() {
        EntryShape::Line => return,
        EntryShape::Record { bytes } => (0, bytes),
        EntryShape::Headed { header } => {
            for cut in [header - 1, header / 2, 8] {
                let said = trace_in(&input[..cut], &Reading::plain().of(import), imports).err().unwrap_or_default();
                let expected = format!("the header: the input ends after {cut} of its {header} bytes");
                assert_eq!(said, expected, "{word}: a header that is cut");
            }
            (header, import.parser().header(&input[..header]).expect("the header of its example"))
        }
    };
    let records = input.len() - header;
    assert!(records.is_multiple_of(bytes), "{word}: its example is no number of records of {bytes} bytes");
    for cut in records - bytes + 1..records {
        let found = trace_in(&input[..header + cut], &Reading::plain().of(import), imports).err();
        let said = found.unwrap_or_default();
        let expected = format!("record {}: the input ends after {} of its {bytes} bytes", records / bytes, cut % bytes);
        assert_eq!(said, expected, "{word}: a record that is cut");
    }
}

/// How many inputs are made up for a format.
const MADE_UP: u64 = 200;

fn no_bytes_make_it_panic(import: &'static dyn TraceImport, imports: &Registry<dyn TraceImport>) {
    let example = import.example().input;
    for number in 0..MADE_UP {
        let mut random = Random::new(&[number]);
        let mut below = |n: usize| (random.next_u64() % n as u64) as usize;
        // The example with some bytes changed, or any bytes.
        let mut input = example.to_vec();
        if number % 2 == 0 {
            (0..below(4)).for_each(|_| input[below(example.len())] = below(256) as u8);
        } else {
            input = (0..below(80)).map(|_| below(256) as u8).collect();
        }
        // Not sizes of their own: gigabytes of pages take their time.
        let reading = Reading { access_size: Some(4), ..Reading::plain().of(import) };
        if let Err(fault) = trace_in(&input, &reading, imports) {
            let placed = ["line ", "record ", "the header", "the end", "the compressed input"]
                .iter()
                .any(|place| fault.starts_with(place));
            assert!(placed, "{}: an error without its place: {fault}", import.word());
        }
    }
}
