//! Are the columns of a CSV file found, whatever they are called?

use super::*;

fn columns(names: &str) -> Reading {
    Reading { columns: Some(names.split(',').map(str::to_owned).collect()), ..plain(None) }
}

#[test]
fn a_file_with_other_names_is_read_with_columns() {
    let text = b"time,LBN,size\n1,100,4\n2,0x200,8\n";
    let expected: Accesses = vec![(R, 100, 4), (R, 512, 8)];
    // By place, by name, and by role and name.
    for asked in ["_,address,size", "lbn,size", "time,lbn,size", "address=lbn,size=size", "size,address=lbn"] {
        assert_eq!(read(text, &columns(asked)), Ok(("csv", expected.clone())), "{asked}");
    }
    let lengths = |asked: &str| read(text, &columns(asked)).map(|(_, all)| all.into_iter().map(|a| a.2).collect());
    assert_eq!(lengths("lbn"), Ok(vec![4, 8]), "a column that is called size is the size");
    assert_eq!(lengths("address=lbn,size=time"), Ok(vec![1, 2]));
    let kinds = read(b"what,where\nget,7\nSET,9\n", &columns("address=where,kind=what"));
    assert_eq!(kinds, Ok(("csv", vec![(R, 7, 1), (W, 9, 1)])));
    // Names for a file without a line of them.
    assert_eq!(read(b"1,100,4\n", &columns("time,lbn,size")), Ok(("csv", vec![(R, 100, 4)])));
}

#[test]
fn a_first_line_may_name_the_address_otherwise() {
    for text in ["# time, object\n1,100\n", "time;obj_id\n1;100\n", "# made by x\nsize,addr\n,100\n# end\n"] {
        assert_eq!(read(text.as_bytes(), &plain(None)), Ok(("csv", vec![(R, 100, 1)])), "{text}");
    }
    // Two that may be the address: which is not said.
    let fault = read(b"object,lbn\n1,100\n", &plain(Some("csv"))).unwrap_err();
    assert!(fault.contains("`object`"), "{fault}");
    assert_eq!(read(b"object,lbn\n1,100\n", &columns("lbn")), Ok(("csv", vec![(R, 100, 1)])));
}

#[test]
fn keys_are_addresses_of_their_own() {
    let addresses = |text: &str, asked: &str| -> Vec<(u64, u32)> {
        let (format, all) = read(text.as_bytes(), &columns(asked)).unwrap();
        assert_eq!(format, "csv");
        all.into_iter().map(|access| (access.1, access.2)).collect()
    };
    // By role and name; by place, under a line of names and without one, though no field begins with a digit.
    let named = addresses("time,url,size\n1,/a.png,40\n2,\"b c\",50\n3,/a.png,60\n", "key=url");
    let placed = addresses("/a.png,40\nb c,50\n/a.png,60\n", "key,size");
    assert_eq!(named, placed);
    assert_eq!(addresses("key,size\n/a.png,40\nb c,50\n/a.png,60\n", "key,size"), placed);
    assert_eq!(placed.iter().map(|access| access.1).collect::<Vec<_>>(), [40, 50, 60]);
    assert!(placed[0].0 == placed[2].0 && placed[0].0 != placed[1].0, "{placed:?}");
    assert_eq!(addresses("b c\n", "key")[0].0, placed[1].0);
    // A number is a key like any other, not that address; zeros in front make another.
    let numbers = addresses("7\n07\n7\n", "key");
    assert!(numbers[0] == numbers[2] && numbers[0] != numbers[1] && numbers[0].0 != 7, "{numbers:?}");
    // The low half of XXH3-128 of "a", halved, and the page there: what others can compute.
    assert_eq!(addresses("a\n", "key")[0].0, (0xe6c6_32b6_1e96_4e1f >> 1) / 4096 * 4096);
}

#[test]
fn columns_that_make_no_sense_are_refused() {
    for (asked, said) in [
        ("size", "must be address"),
        ("address,adress", "`adress` is none of"),
        ("address,address", "twice"),
        ("address=a,address=b", "twice"),
        ("a,b", "address=NAME"),
        ("where=a", "address=lbn"),
        ("key,address", "twice"),
        ("key=a,b", "`b` is none of"),
    ] {
        let fault = read(b"a,b\n1,2\n", &columns(asked)).unwrap_err();
        assert!(fault.starts_with("not damage: --columns: ") && fault.contains(said), "{asked}: {fault}");
    }
    let fault = read(b"a,b\n1,2\n", &columns("address=lbn")).unwrap_err();
    assert_eq!(fault, "line 1: `a,b` has no column `lbn`");
}
