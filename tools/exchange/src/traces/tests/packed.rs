//! Are archives and frames with long windows read, and what is no trace in them refused?

use super::*;
use zip::write::SimpleFileOptions;

fn archive(files: &[(&str, &[u8])], method: zip::CompressionMethod) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(Cursor::new(vec![]));
    for (name, bytes) in files {
        writer.start_file(*name, SimpleFileOptions::default().compression_method(method)).unwrap();
        writer.write_all(bytes).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

#[test]
fn the_parts_of_a_trace_in_an_archive_follow_one_another() {
    let import = imports().find("drmemtrace").unwrap();
    let whole = import.example().input;
    let expected = read(whole, &plain(None)).unwrap();
    assert_eq!(expected.0, "drmemtrace");
    for method in [zip::CompressionMethod::Stored, zip::CompressionMethod::Deflated] {
        // Cut anywhere, also within an entry.
        for cut in [12, 48, 50] {
            let parts = [("chunk.0000", &whole[..cut]), ("chunk.0001", &whole[cut..])];
            let packed = archive(&parts, method);
            assert_eq!(read(&packed, &plain(None)), Ok(expected.clone()));
            assert_eq!(read(&packed, &plain(Some("drmemtrace"))), Ok(expected.clone()));
        }
        let one = archive(&[("trace.din", b"0 1a\n")], method);
        assert_eq!(read(&one, &plain(None)), Ok(("din", vec![(R, 0x18, 4)])));
    }
}

#[test]
fn other_archives_and_damaged_ones_are_refused() {
    let stored = zip::CompressionMethod::Stored;
    let two = archive(&[("a.din", b"0 1a\n"), ("b.din", b"0 2a\n")], stored);
    assert!(read(&two, &plain(None)).unwrap_err().contains("holds 2 files"));
    let mut damaged = archive(&[("a.din", b"0 1a\n0 2a\n")], stored);
    let place = damaged.windows(4).position(|bytes| bytes == b"0 2a").unwrap();
    damaged[place + 2] = b'3';
    let fault = read(&damaged, &plain(None)).unwrap_err();
    assert!(fault.contains("compressed input (zip)") && fault.contains("checksum"), "{fault}");
    let whole = archive(&[("a.din", b"0 1a\n")], stored);
    for cut in [40, whole.len() - 3] {
        let fault = read(&whole[..cut], &plain(None)).unwrap_err();
        assert!(fault.contains("compressed input (zip) is damaged"), "{fault}");
    }
}

#[test]
fn zstd_may_reach_two_gibibytes_back() {
    let text = b"0 1a\n".repeat(1000);
    let mut encoder = zstd::stream::write::Encoder::new(vec![], 1).unwrap();
    encoder.window_log(31).unwrap();
    encoder.write_all(&text).unwrap();
    let packed = encoder.finish().unwrap();
    assert_eq!(read(&packed, &plain(None)).map(|(_, accesses)| accesses.len()), Ok(1000));
    // Beyond that, a header that asks for 4 GiB (RFC 8878, section 3.1.1.1.2: exponent 22) is refused in words.
    let mut farther = b"\x28\xb5\x2f\xfd\x00".to_vec();
    farther.extend([22 << 3, 1, 0, 0]);
    let fault = read(&farther, &plain(Some("din"))).unwrap_err();
    assert!(fault.contains("needs more than 2 GiB"), "{fault}");
}
