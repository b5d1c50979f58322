//! Are entries understood as their formats mean them, and is nothing taken for one that is none?

use super::*;
use crate::fault::BadInput;
use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink, lay_out};
use pm_formats::{Header, MAGIC};
use proptest::prelude::*;
use std::io::{Cursor, Write as _};

mod columns;
mod in_drips;
mod misread;
mod packed;

#[derive(Default)]
struct Heard(Vec<Access>);

impl TraceSink for Heard {
    fn access(&mut self, access: Access) {
        self.0.push(access);
    }
}

/// As the content tells, or in the format of this word.
fn plain(word: Option<&str>) -> Reading {
    Reading { format: word.map(|word| imports().find(word).unwrap()), ..Reading::plain() }
}

fn open(bytes: &[u8], reading: &Reading) -> anyhow::Result<Opened> {
    super::open(Cursor::new(bytes.to_vec()), reading, &imports())
}

/// Kind, address and length of each access.
type Accesses = Vec<(AccessKind, u64, u32)>;

/// Format and accesses of an input.
fn read(bytes: &[u8], reading: &Reading) -> Result<(&'static str, Accesses), String> {
    let replayed = match open(bytes, reading) {
        Ok(Opened::Foreign(mut trace)) => {
            let mut heard = Heard::default();
            let outcome = trace.replay(&mut heard);
            let bases: Vec<u64> = trace.regions().iter().map(|region| region.base).collect();
            let place = |a: Access| (a.kind, bases[usize::from(a.region)] + a.offset, a.len);
            outcome.map(|()| (trace.format().word(), heard.0.into_iter().map(place).collect()))
        }
        Ok(Opened::Ours(_)) => return Err("ours".into()),
        Err(error) => Err(error),
    };
    match replayed {
        Ok(read) => Ok(read),
        Err(error) => {
            let damage = error.chain().any(|cause| {
                let inner = cause.downcast_ref::<std::io::Error>().and_then(std::io::Error::get_ref);
                cause.is::<BadInput>() || inner.is_some_and(|inner| inner.is::<BadInput>())
            });
            Err(format!("{}{error:#}", if damage { "" } else { "not damage: " }))
        }
    }
}

const R: AccessKind = AccessKind::Read;
const W: AccessKind = AccessKind::Write;
const M: AccessKind = AccessKind::ReadModifyWrite;

#[test]
fn texts_tell_their_formats_and_say_what_was_accessed() {
    let lackey =
        "==12== Lackey, an example\n==12== \n\nI  0023c790,2\n S be80199c,4\n L 0025747c,1\r\n M ffffffffffffffff,1\n";
    for (text, word, expected) in [
        (lackey, "lackey", vec![(W, 0xbe80_199c, 4), (R, 0x25_747c, 1), (M, u64::MAX, 1)]),
        ("0 1003 first\n1 0xABC\n2 40\n3 7", "din", vec![(R, 0x1000, 4), (W, 0xabc, 4), (R, 4, 4)]),
        ("r 1003 14\nw ff 0\ni 0 4\nm 10 10\n", "xdin", vec![(R, 0x1003, 20), (W, 255, 0), (R, 16, 16)]),
        ("0x1000 READ 0\n0x40 WRITE 17\n", "dramsim3", vec![(R, 4096, 64), (W, 64, 64)]),
        ("LD 0x1000\nST 64\n", "ramulator2", vec![(R, 4096, 64), (W, 64, 64)]),
        ("0x1000\n17\n\n", "csv", vec![(R, 4096, 1), (R, 17, 1)]),
        ("17,4,w\n0x11;8;rmw\n18\t2\tLoad\n19,,\n", "csv", vec![(W, 17, 4), (M, 17, 8), (R, 18, 2), (R, 19, 1)]),
        ("pc,Kind,\"Address\",x\n7,write,0x20,9\n7,I,0x20,9\n", "csv", vec![(W, 32, 1)]),
        ("address,size\n", "csv", vec![]),
    ] {
        assert_eq!(read(text.as_bytes(), &plain(None)), Ok((word, expected.clone())), "{text}");
        assert_eq!(read(text.as_bytes(), &plain(Some(word))), Ok((word, expected)), "{text}");
    }
}

#[test]
fn binary_formats_are_named_and_never_guessed() {
    let oracle =
        [&7u32.to_le_bytes()[..], &0x1234u64.to_le_bytes(), &20u32.to_le_bytes(), &(-1i64).to_le_bytes()].concat();
    for (bytes, word, expected) in [
        (vec![0, 16, 0, 0, 255, 255, 255, 255], "raw32", vec![(R, 4096, 1), (R, 0xffff_ffff, 1)]),
        (vec![0, 16, 0, 0, 255, 255, 255, 255], "raw64", vec![(R, 0xffff_ffff_0000_1000, 1)]),
        (vec![3, 16, 0, 0, 20, 1, 1, 0], "dinb", vec![(W, 0x1003, 276)]),
        (oracle, "oracleGeneral", vec![(R, 0x1234, 20)]),
    ] {
        assert_eq!(read(&bytes, &plain(Some(word))), Ok((word, expected)));
        assert!(read(&bytes, &plain(None)).unwrap_err().contains("named with --input"), "{word:?}");
        let cut = read(&bytes[..bytes.len() - 1], &plain(Some(word))).unwrap_err();
        assert!(cut.starts_with("record ") && cut.contains("the input ends after"), "{cut}");
    }
}

#[test]
fn options_change_what_an_entry_means() {
    let sized = Reading { access_size: Some(8), ..plain(None) };
    assert_eq!(
        read(b"0 1003\n", &Reading { access_size: Some(8), ..plain(Some("din")) }).unwrap().1,
        [(R, 0x1003, 8)],
        "as it stands, not as a word"
    );
    assert_eq!(read(b"17,4\n", &sized).unwrap().1, [(R, 17, 8)]);
    let lines = Reading { address_unit: 128, ..plain(None) };
    assert_eq!(read(b"17\n", &lines).unwrap().1, [(R, 17 * 128, 1)]);
    // Numbers of lines that are addresses of more than 64 bits stay apart.
    let (_, beyond) = read(b"1\n0x1ffffffffffffff\n0x200000000000000\n0x200000000000001\n", &lines).unwrap();
    assert_eq!(beyond[..3], [(R, 128, 1), (R, u64::MAX - 127, 1), (R, 1 << 52, 1)]);
    assert_eq!(beyond[3], (R, (1 << 52) + 128, 1));
    let columns =
        |names: &[&str]| Reading { columns: Some(names.iter().map(|&name| name.to_owned()).collect()), ..plain(None) };
    assert_eq!(read(b"1,2,3,r\n", &columns(&["_", "size", "address"])).unwrap().1, [(R, 3, 2)]);
    assert!(read(b"1,2\n", &columns(&["size"])).unwrap_err().contains("must be address"));
    assert!(read(b"1,2\n", &columns(&["address", "adress"])).unwrap_err().contains("--columns"));
    let lackey = b"I 10,3\n L 20,4\n";
    let which = |references| read(lackey, &Reading { references, ..plain(None) }).unwrap().1;
    assert_eq!(which(References::Instructions), [(R, 16, 3)]);
    assert_eq!(which(References::All), [(R, 16, 3), (R, 32, 4)]);
    let Ok(Opened::Foreign(mut trace)) = open(lackey, &plain(None)) else { panic!() };
    trace.replay(&mut Heard::default()).unwrap();
    assert_eq!(trace.left_out(), 1);
}

#[test]
fn faults_are_told_with_their_line() {
    for (text, expected) in [
        ("0 1a\n0 1g\n", "line 2: `1g` is no hexadecimal number"),
        ("0 1a\n\n0\n", "line 3: `0` is not a label and an address"),
        ("0 1a\n4 10\n", "line 2: label 4 tells a cache"),
        ("0 1a\n9 10\n", "line 2: label 9 is none of"),
        ("0 1a\n0 10000000000000000\n", "line 2: `10000000000000000` does not fit 64 bits"),
        (" L 10,4\nhello\n", "line 2: `hello` is no line of lackey"),
        (" L 10,4\n L 10,4294967296\n", "line 2: an access of 4294967296 bytes"),
        (" L 10,4\n L ffffffffffffffff,2\n", "line 2: 2 bytes at address 0xffffffffffffffff x 1 reach beyond"),
        (" L 10,4\n L -1,4\n", "line 2: `-1` is no hexadecimal number"),
        ("r 10 4\nx 10 4\n", "line 2: label `x` is none of"),
        ("17\n18446744073709551616\n", "line 2: `18446744073709551616` does not fit 64 bits"),
        ("17\n1,2,3,4\n", "line 2: kind `3` is none of"),
        ("17\n,2\n", "line 2: `,2` has no address"),
        ("17\n1\0\n", "line 2: `1\\0` is no text"),
        ("0x10 READ 1\n0x10 READ\n", "line 2: `0x10 READ` is not an address"),
        ("LD 1\nLD 1 2\n", "line 2: `LD 1 2` is not LD or ST"),
    ] {
        let fault = read(text.as_bytes(), &plain(None)).unwrap_err();
        assert!(fault.starts_with(expected), "{text:?}: {fault}");
    }
    let long = format!("17\n{}\n", "1".repeat(1 << 17));
    assert!(read(long.as_bytes(), &plain(None)).unwrap_err().starts_with("line 2: longer than"));
    for text in ["hello\n", "\n\n", "1,2,3,4\n", "0 zz\n", "x,y\n"] {
        assert!(read(text.as_bytes(), &plain(None)).unwrap_err().contains("neither a pm stream"), "{text:?}");
    }
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(vec![], flate2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn zstandard(bytes: &[u8]) -> Vec<u8> {
    zstd::stream::encode_all(bytes, 1).unwrap()
}

fn xz(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = lzma_rust2::XzWriter::new(vec![], lzma_rust2::XzOptions::with_preset(1)).unwrap();
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn bzip2(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = bzip2::write::BzEncoder::new(vec![], bzip2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn compressed_inputs_are_read_and_their_damage_is_seen() {
    let text = (0..4000u64).map(|i| format!("0 {:x}\n", i * 4 + i * i % 1000 * 4096)).collect::<String>();
    let expected = read(text.as_bytes(), &plain(None)).unwrap();
    assert_eq!(expected.1.len(), 4000);
    for pack in [gzip, zstandard, xz, bzip2] {
        let packed = pack(text.as_bytes());
        assert_eq!(read(&packed, &plain(None)).as_ref(), Ok(&expected));
        assert_eq!(read(&packed, &plain(Some("din"))).as_ref(), Ok(&expected));
        assert_eq!(read(&pack(&packed), &plain(None)).unwrap_err().split(' ').next(), Some("this"), "packed once only");
        // Frames one after another are one input.
        let middle = text.find('\n').unwrap() + 1;
        let two = [pack(&text.as_bytes()[..middle]), pack(&text.as_bytes()[middle..])].concat();
        assert_eq!(read(&two, &plain(None)).as_ref(), Ok(&expected));
        // Zeros behind xz are padding, four at a time (section 2.2 of its specification).
        for tail in [&b"x"[..], b"0 10\n", if packed.starts_with(b"\xfd7zXZ") { &[0; 41] } else { &[0; 40] }] {
            let found = read(&[&packed, tail].concat(), &plain(None)).map(|(_, accesses)| accesses.len());
            let fault = found.unwrap_err();
            assert!(fault.starts_with("the compressed input"), "{tail:?}: {fault}");
        }
        for cut in [packed.len() - 1, packed.len() / 2, 12] {
            let fault = read(&packed[..cut], &plain(None)).map(|(_, accesses)| accesses.len()).unwrap_err();
            assert!(fault.starts_with("the compressed input"), "cut at {cut}: {fault}");
        }
    }
}

#[test]
fn a_stream_of_ours_is_ours_also_compressed_and_damaged_it_is_nobodys() {
    let mut header = Header::empty();
    header.regions = regions();
    let trace = pm_formats::trace::TraceWriter::new(vec![], &header).unwrap().finish(vec![]).unwrap();
    for bytes in [trace.clone(), gzip(&trace), zstandard(&trace)] {
        let Ok(Opened::Ours(blocks)) = open(&bytes, &plain(None)) else { panic!("not ours") };
        let mut reader = pm_formats::trace::TraceReader::from_blocks(blocks).unwrap();
        assert!(reader.replay_block(&mut Heard::default()).unwrap().is_none());
    }
    for bit in 0..8 * 64 {
        let mut damaged = trace.clone();
        damaged[bit / 8] ^= 1 << (bit % 8);
        assert!(read(&damaged, &plain(None)).unwrap_err() != "ours", "bit {bit}");
    }
    for cut in 0..MAGIC.len() {
        assert!(read(&trace[..cut], &plain(None)).unwrap_err().contains("stops before its end block"), "cut at {cut}");
    }
}

fn regions() -> Vec<Region> {
    lay_out([("a".into(), 20_000, 20, Coding::Records), ("b".into(), 5000, 1, Coding::Records)])
}

fn any_access() -> impl Strategy<Value = Access> {
    (prop_oneof![Just(R), Just(W), Just(M)], 0u16..2, 0u64..4500, 0u32..500)
        .prop_map(|(kind, region, offset, len)| Access { kind, region, len, offset })
}

fn exported(word: &str, line: Option<u64>, accesses: &[Access]) -> Vec<u8> {
    let regions = regions();
    let mut exporter = Exporter::new(exports().find(word).unwrap(), line, &regions, vec![]).unwrap();
    for &access in accesses {
        exporter.search(&[]);
        exporter.access(access);
        exporter.search_end();
    }
    exporter.finish().unwrap()
}

proptest! {
    #[test]
    fn what_is_written_is_read_again(accesses in prop::collection::vec(any_access(), 1..50)) {
        let bases: Vec<u64> = regions().iter().map(|region| region.base).collect();
        let place = |a: &Access| (a.kind, bases[usize::from(a.region)] + a.offset, a.len);
        let all: Vec<_> = accesses.iter().map(place).collect();
        let apart = |steps: &[(AccessKind, u64, u32)]| -> Vec<_> {
            let apart = |&(kind, address, len)| if kind == M { vec![(R, address, len), (W, address, len)] } else { vec![(kind, address, len)] };
            steps.iter().flat_map(apart).collect()
        };
        for word in ["lackey", "csv"] {
            prop_assert_eq!(read(&exported(word, None, &accesses), &plain(None)), Ok((word, all.clone())));
        }
        prop_assert_eq!(read(&exported("xdin", None, &accesses), &plain(None)), Ok(("xdin", apart(&all))));
        prop_assert_eq!(read(&exported("dinb", None, &accesses), &plain(Some("dinb"))), Ok(("dinb", apart(&all))));
        // Without kinds; the pieces of lines without sizes.
        let lines: Vec<_> = all.iter().flat_map(|&(kind, address, len)| {
            (address / 64..=(address + u64::from(len.max(1)) - 1) / 64).map(move |line| (kind, line * 64, 64))
        }).collect();
        for (word, kinds) in [("raw32", false), ("raw64", false), ("oracleGeneral", false), ("din", true), ("dramsim3", true), ("ramulator2", true)] {
            let expected = if kinds { apart(&lines) } else { lines.iter().map(|&(_, address, len)| (R, address, len)).collect() };
            let reading = Reading { access_size: Some(64), ..plain(Some(word)) };
            prop_assert_eq!(read(&exported(word, Some(64), &accesses), &reading), Ok((word, expected)));
        }
        // Pieces add up to the access, and none crosses a line.
        let (_, pieces) = read(&exported("csv", Some(16), &accesses), &plain(None)).unwrap();
        prop_assert!(pieces.iter().all(|&(_, address, len)| address % 16 + u64::from(len) <= 16));
        prop_assert_eq!(pieces.iter().map(|piece| u64::from(piece.2)).sum::<u64>(), all.iter().map(|access| u64::from(access.2)).sum::<u64>());
    }

    #[test]
    fn the_next_request_of_an_object_is_the_next_there_is(objects in prop::collection::vec(0u64..20, 1..100)) {
        let accesses: Vec<Access> = objects.iter().map(|object| Access::read(0, object * 64, 20)).collect();
        let bytes = exported("oracleGeneral", Some(64), &accesses);
        prop_assert_eq!(bytes.len(), 24 * objects.len());
        for (i, request) in bytes.chunks(24).enumerate() {
            let later = objects[i + 1..].iter().position(|object| *object == objects[i]);
            let expected = later.map_or(-1, |later| (i + 1 + later) as i64);
            prop_assert_eq!(i64::from_le_bytes(request[16..].try_into().unwrap()), expected);
            prop_assert_eq!(u64::from_le_bytes(request[4..12].try_into().unwrap()), 4096 + 64 * objects[i]);
            prop_assert_eq!(u32::from_le_bytes(request[..4].try_into().unwrap()), i as u32);
        }
    }

    #[test]
    fn no_bytes_make_a_parser_panic(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
        for import in imports().iter() {
            // Not their own sizes: gigabytes of pages take their time.
            let _ = read(&bytes, &Reading { access_size: Some(4), ..plain(Some(import.word())) });
            if import.shape().is_text() {
                let _ = import.parser().parse(&bytes);
            }
        }
        let _ = read(&bytes, &plain(None));
    }
}

#[test]
fn next_requests_are_found_across_chunks() {
    // More than two chunks of requests, each object every 100,000 of them.
    let accesses: Vec<Access> = (0..150_000u64).map(|i| Access::read(0, i % 100_000, 0)).collect();
    let regions = lay_out([("a".into(), 100_000, 1, Coding::Records)]);
    let mut exporter = Exporter::new(exports().find("oracleGeneral").unwrap(), None, &regions, vec![]).unwrap();
    accesses.iter().for_each(|&access| exporter.access(access));
    let bytes = exporter.finish().unwrap();
    for (i, request) in bytes.chunks(24).enumerate() {
        let expected = if i < 50_000 { i as i64 + 100_000 } else { -1 };
        assert_eq!(i64::from_le_bytes(request[16..].try_into().unwrap()), expected, "request {i}");
    }
}

#[test]
fn what_a_format_cannot_say_is_an_error() {
    let regions = vec![Region { base: 1 << 40, ..regions()[0].clone() }];
    for word in ["raw32", "dinb"] {
        let mut exporter = Exporter::new(exports().find(word).unwrap(), None, &regions, vec![]).unwrap();
        exporter.access(Access::read(0, 40, 20));
        exporter.access(Access::read(0, 60, 20));
        let fault = exporter.finish().unwrap_err().to_string();
        assert_eq!(fault, format!("20 bytes at address 0x10000000028 do not fit {word}"));
    }
}

#[test]
fn every_format_does_what_formats_do() {
    crate::trial::imports(&imports());
    crate::trial::exports(&exports(), &imports());
}
