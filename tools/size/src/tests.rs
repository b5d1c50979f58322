//! Are sizes read and printed as people write them?

use super::*;

fn read(text: &str) -> Result<u64, SizeError> {
    text.parse::<Bytes>().map(|b| b.0)
}

#[test]
fn units_are_powers_of_1024() {
    for (text, bytes) in [
        ("0", 0),
        ("512", 512),
        ("512B", 512),
        ("128K", 131_072),
        ("128k", 131_072),
        ("128KiB", 131_072),
        ("64M", 64 << 20),
        ("64MiB", 64 << 20),
        ("3G", 3 << 30),
        ("1T", 1 << 40),
        ("15E", 15 << 60),
        ("18446744073709551615", u64::MAX),
    ] {
        assert_eq!(read(text), Ok(bytes), "{text}");
    }
}

#[test]
fn what_could_mean_two_things_is_refused_with_what_would_do() {
    for text in ["128KB", "128kB", "128kb"] {
        let message = read(text).unwrap_err().to_string();
        assert!(message.contains("write 128K (or 128KiB)"), "{message}");
    }
}

#[test]
fn what_is_not_a_size_is_refused() {
    for text in ["", "K", "-1", "+1", "1.5M", "1 M", " 1", "1_000", "12x", "1KiBB", "0x10", "1Ki", "१"] {
        assert!(read(text).is_err(), "{text}");
    }
}

#[test]
fn overflow_is_refused_not_wrapped() {
    for text in ["18446744073709551616", "16E", "18014398509481984K", "99999999999999999999999"] {
        assert!(matches!(read(text), Err(SizeError::TooLarge(_))), "{text}");
    }
}

#[test]
fn what_is_printed_reads_back() {
    for bytes in [0, 1, 1000, 1023, 1024, 1025, 1536, 131_072, 5 << 20, 1 << 63, u64::MAX, (1 << 30) + 1024] {
        assert_eq!(read(&Bytes(bytes).to_string()), Ok(bytes));
    }
    assert_eq!(Bytes(131_072).to_string(), "128K");
    assert_eq!(Bytes(1536).to_string(), "1536");
    assert_eq!(format!("{:>6}", Bytes(64 << 20)), "   64M");
}
