//! Inputs of others: traces in each format, rows of numbers.

use super::{files, root, streams};
use pm_exchange::traces::imports;

/// The example of each format, read as that and as its content tells, and traces that were compressed.
pub(super) fn traces() -> Vec<Vec<u8>> {
    let read_as = |format: u8, data: &[u8]| [&[format], data].concat();
    let mut all = vec![read_as(u8::MAX, &streams::trace(None))];
    for (format, import) in (0..).zip(imports().iter()) {
        let input = import.example().input;
        all.extend([read_as(format, input), read_as(u8::MAX, input)]);
    }
    let data = root().join("tests/data");
    for packed in
        [files(&data, ".zst"), files(&data.join("lcs"), ".zst"), files(&root().join("tests/fuzz/packed"), "")].concat()
    {
        all.push(read_as(u8::MAX, &packed));
    }
    all
}

/// Text and numbers, read in each way.
pub(super) fn rows() -> Vec<Vec<u8>> {
    let texts: [&[u8]; 4] = [
        b"x,y,z,power_r,power_g,power_b\n1,2,3,1,1,1\n",
        b"x y z n_x n_y n_z pixel sample weight_r weight_g weight_b batch\n1 2 3 0 1 0 5 1 1 1 1 0\n",
        b"x\ty\tz\tmaterial\tdiffuse_r\tdiffuse_g\tdiffuse_b\n1\t2\t3\t0\t.5\t.5\t.5\n2\t2\t3\t1\t.5\t.5\t.25\n",
        b"1;2;3;0;1;1;1\n",
    ];
    let floats: Vec<u8> = (0..21u8).flat_map(|i| f32::from(i).to_le_bytes()).collect();
    let with = |how: u8| {
        texts.iter().copied().chain([&floats[..]]).map(move |data| [&[how], data].concat()).collect::<Vec<_>>()
    };
    (0..16).flat_map(with).collect()
}
