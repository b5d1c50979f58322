//! Is nothing taken for what it is not: signatures are heeded, doubtful texts ask, and no access is absurdly long?

use super::*;

/// A file of libCacheSim with `requests` of version 2.
fn lcs(requests: u64) -> Vec<u8> {
    let magic = 0x1234_5678_9abc_def0_u64.to_le_bytes();
    let mut file = [&magic[..], &2u64.to_le_bytes(), &[0; 8192 - 24], &magic].concat();
    for request in 0..requests {
        file.extend([&1u32.to_le_bytes()[..], &(request * 4096).to_le_bytes(), &20u32.to_le_bytes()].concat());
        file.extend([&[1, 0, 0, 0][..], &(-1i64).to_le_bytes()].concat());
    }
    file
}

#[test]
fn a_file_with_a_signature_is_what_that_says() {
    let file = lcs(10);
    let expected: Accesses = (0..10).map(|request| (R, request * 4096, 20)).collect();
    for packed in [file.clone(), gzip(&file), zstandard(&file)] {
        assert_eq!(read(&packed, &plain(None)), Ok(("lcs", expected.clone())));
        assert_eq!(read(&packed, &plain(Some("lcs"))), Ok(("lcs", expected.clone())));
        let fault = read(&packed, &plain(Some("oracleGeneral"))).unwrap_err();
        assert_eq!(fault, "not damage: --input oracleGeneral, but the input is lcs: leave --input out");
    }
    let mut header = Header::empty();
    header.regions = regions();
    let ours = pm_formats::trace::TraceWriter::new(vec![], &header).unwrap().finish(vec![]).unwrap();
    for word in ["raw64", "din", "lcs", "csv"] {
        let fault = read(&ours, &plain(Some(word))).unwrap_err();
        assert!(fault.contains("the input is a stream of ours: leave --input out"), "{word}: {fault}");
    }
}

#[test]
fn other_files_are_refused_by_name() {
    for (beginning, said) in [
        (&b"PAR1"[..], "Parquet"),
        (b"\x93NUMPY\x01\0v\0", "array of NumPy"),
        (b"\x89HDF\r\n\x1a\n", "HDF5"),
        (b"gem5", "decode_packet_trace"),
        (b"\x7fELF", "a program"),
    ] {
        let file = [beginning, &[0; 800]].concat();
        for word in [None, Some("raw64"), Some("csv")] {
            let fault = read(&file, &plain(word)).unwrap_err();
            assert!(fault.starts_with("this is no trace that is read") && fault.contains(said), "{word:?}: {fault}");
        }
    }
    let twice = gzip(&gzip(b"0 1a\n"));
    assert!(read(&twice, &plain(Some("raw64"))).unwrap_err().contains("compressed twice"));
}

#[test]
fn a_text_is_no_binary_trace() {
    // 16 bytes, so that it might be two addresses.
    for word in ["raw32", "raw64", "dinb"] {
        let fault = read(b"0 1003\n1 100ab4\n", &plain(Some(word))).unwrap_err();
        assert_eq!(fault, format!("not damage: --input {word}, but the input is a text: leave --input out"));
    }
    // Letters alone make no text: these are addresses.
    assert_eq!(read(b"abcdefghijklmnop", &plain(Some("raw64"))).map(|(_, accesses)| accesses.len()), Ok(2));
}

#[test]
fn a_text_that_fits_two_formats_asks() {
    let bubbles = b"3 20734016\n1 20846400\n2 20734208\n";
    let asked = "not damage: this text may be din or ramulator-cpu: say which with --input";
    assert_eq!(read(bubbles, &plain(None)).unwrap_err(), asked);
    let expected = vec![(R, 20_734_016, 64), (R, 20_846_400, 64), (R, 20_734_208, 64)];
    assert_eq!(read(bubbles, &plain(Some("ramulator-cpu"))), Ok(("ramulator-cpu", expected)));
    let expected = vec![(R, 0x2073_4014, 4), (W, 0x2084_6400, 4)];
    assert_eq!(read(&bubbles[..22], &plain(Some("din"))), Ok(("din", expected)));
    // A label that is none, a third address or a digit that is hexadecimal tell.
    for (line, word) in [("7 40", "ramulator-cpu"), ("2 40 80", "din or ramulator-cpu"), ("2 4c", "din")] {
        let found = read(format!("1 20\n{line}\n").as_bytes(), &plain(None)).map(|(word, _)| word);
        match word.split_once(" or ") {
            None => assert_eq!(found, Ok(word), "{line}"),
            Some(_) => assert_eq!(found, Err(asked.into()), "{line}"),
        }
    }
    // However late that is, as long as it is within the beginning.
    let late = format!("{}0 4c\n", "1 20\n".repeat(10_000));
    assert_eq!(read(late.as_bytes(), &plain(None)).map(|(word, _)| word), Ok("din"));
    assert!(read(b"0\t1000\n", &plain(None)).unwrap_err().contains("din or csv or ramulator-cpu"));
}

#[test]
fn no_access_is_absurdly_long() {
    let sized = |len: u32| [&[0; 12][..], &len.to_le_bytes(), &[255; 8]].concat();
    let most = 1 << 24;
    assert_eq!(read(&sized(most), &plain(Some("oracleGeneral"))), Ok(("oracleGeneral", vec![(R, 0, most)])));
    let fault = read(&sized(most + 1), &plain(Some("oracleGeneral"))).unwrap_err();
    assert!(fault.starts_with("record 1: an access of 16777217 bytes; more than 16777216"), "{fault}");
    let told = Reading { access_size: Some(64), ..plain(Some("oracleGeneral")) };
    assert_eq!(read(&sized(most + 1), &told), Ok(("oracleGeneral", vec![(R, 0, 64)])));
    assert!(read(b" L 10,4\n L 10,16777217\n", &plain(None)).unwrap_err().starts_with("line 2: an access of 16777217"));
}

#[test]
fn empty_lines_and_marks_are_passed_over() {
    for import in imports().iter().filter(|import| import.shape().is_text()) {
        let (word, text) = (import.word(), std::str::from_utf8(import.example().input).unwrap());
        let expected = read(text.as_bytes(), &plain(None)).unwrap();
        let spread = format!("\n{}\n", text.replace('\n', "\n \t\r\n\n"));
        let marked = format!("\u{feff}{text}");
        for changed in [spread, marked, text.replace('\n', "\r\n")] {
            for asked in [None, Some(word)] {
                assert_eq!(read(changed.as_bytes(), &plain(asked)), Ok(expected.clone()), "{word}: {changed:?}");
            }
        }
    }
    let wide: Vec<u8> = "\u{feff}0 1a\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for asked in [None, Some("din")] {
        assert!(read(&wide, &plain(asked)).unwrap_err().contains("UTF-16"), "{asked:?}");
    }
    // For bare addresses it is no mark.
    assert_eq!(read(b"\xef\xbb\xbf\0", &plain(Some("raw32"))), Ok(("raw32", vec![(R, 0xbf_bbef, 1)])));
}

#[test]
fn what_ends_too_soon_is_seen_where_the_format_can_tell() {
    let whole = imports().find("drmemtrace").unwrap().example().input;
    let mut promising = lcs(3);
    promising[24] = 3;
    assert!(read(whole, &plain(None)).is_ok() && read(&promising, &plain(None)).is_ok());
    // Between two entries, where nothing else is missing.
    let fault = read(&whole[..whole.len() - 12], &plain(None)).unwrap_err();
    assert_eq!(fault, "the end: no footer: the trace is cut");
    let fault = read(&promising[..promising.len() - 28], &plain(None)).unwrap_err();
    assert_eq!(fault, "the end: 2 requests, and the header promises 3");
    let unlogged = b"core   0: 0x0000000080000044 (0x0005a503) lw      a0, 0(a1)\n";
    assert!(read(unlogged, &plain(Some("spike"))).unwrap_err().contains("--log-commits"));
}
