//! What is read is what was meant, and what cannot be meant is refused with its place.

use super::{RowOptions, photons, queries};
use pm_formats::{Bounds, Photon, Query, Record, RecordReader, Step};
use proptest::prelude::*;

fn step() -> Step {
    Step {
        program: "pm-view".into(),
        version: String::new(),
        arguments: vec![],
        seed: None,
        input: None,
        inputs: vec![],
    }
}

fn plain() -> RowOptions {
    RowOptions { columns: None, raw: false, emitted: 1, size: None }
}

fn with_columns(columns: &str) -> RowOptions {
    RowOptions { columns: Some(columns.split(',').map(str::to_owned).collect()), ..plain() }
}

fn records<T: Record>(stream: &[u8]) -> Vec<T> {
    let mut reader = RecordReader::<T, _>::new(stream).unwrap();
    let mut all = vec![];
    while let Some((_, block)) = reader.next_block().unwrap() {
        all.extend(block);
    }
    all
}

fn import_photons(text: &[u8], options: &RowOptions) -> anyhow::Result<Vec<Photon>> {
    Ok(records(&photons(text, options, step())?.write(vec![])?))
}

fn import_queries(text: &[u8], options: &RowOptions) -> anyhow::Result<Vec<Query>> {
    Ok(records(&queries(text, options, step())?.write(vec![])?))
}

#[test]
fn every_separator_and_a_line_of_names() {
    let expected = import_photons(b"x,y,z,power_r,power_g,power_b\n1,2,3,4,4,4\n-1,0.5,1e3,8,0,8\n", &plain()).unwrap();
    assert_eq!(expected.len(), 2);
    assert_eq!(expected[1].position, [-1.0, 0.5, 1000.0]);
    assert_eq!(expected[1].power(), [8.0, 0.0, 8.0]);
    assert_eq!(expected[1].normal(), [0.0, 1.0, 0.0]);
    for text in [
        "x;y;z;power_r;power_g;power_b\r\n1;2;3;4;4;4\r\n\r\n-1;0.5;1e3;8;0;8",
        "# x\ty\tz\tpower_r\tpower_g\tpower_b\n1\t2\t3\t4\t4\t4\n# more\n-1\t0.5\t1e3\t8\t0\t8\n",
        "\u{feff}x y  z power_r power_g power_b\n 1 2 3 4 4 4 \n-1 0.5 1e3   8 0 8\n",
        "\"x\", y, z, power_r, power_g, power_b\n1, 2, 3, 4, 4, 4\n-1, 0.5, 1e3, 8, 0, 8\n",
        "power_b,power_g,power_r,z,y,x\n4,4,4,3,2,1\n8,0,8,1e3,0.5,-1\n",
    ] {
        assert_eq!(import_photons(text.as_bytes(), &plain()).unwrap(), expected, "{text}");
    }
    // Names typed, with a line of names in the file and without.
    let typed = with_columns("x,y,z,_,power_r,power_g,power_b");
    for text in ["1 2 3 nan 4 4 4\n-1 .5 1e3 ? 8 0 8\n", "a b c d e f g\n1 2 3 nan 4 4 4\n-1 .5 1e3 ? 8 0 8\n"] {
        assert_eq!(import_photons(text.as_bytes(), &typed).unwrap(), expected, "{text}");
    }
    let raw: Vec<u8> = [1f32, 2., 3., 9., 4., 4., 4., -1., 0.5, 1e3, f32::NAN, 8., 0., 8.]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    assert_eq!(import_photons(&raw, &RowOptions { raw: true, ..typed.clone() }).unwrap(), expected);
    let error = import_photons(&raw[..30], &RowOptions { raw: true, ..typed }).unwrap_err().to_string();
    assert!(error.contains("record 2: 2 bytes"), "{error}");
}

#[test]
fn faults_name_their_line() {
    let fault = |text: &str| import_photons(text.as_bytes(), &plain()).unwrap_err().to_string();
    for (row, expected) in [
        ("1,nan,3,4,4,4", "line 3: y is `nan`; a finite number is needed"),
        ("1,2,inf,4,4,4", "line 3: z is `inf`; a finite number is needed"),
        ("1,2,1e39,4,4,4", "line 3: z is `1e39`; a finite number is needed"),
        ("1,2,,4,4,4", "line 3: z is missing"),
        ("1,2,3,4,4", "line 3: 5 fields, but there are 6 columns"),
        ("1,2,3,4,-4,4", "line 3: power 4, -4, 4: numbers of 0 to 2^127 are needed"),
    ] {
        assert_eq!(fault(&format!("x,y,z,power_r,power_g,power_b\n1,2,3,4,4,4\n{row}\n")), expected);
    }
    assert!(fault("x,y,z,n_x,n_y,n_z\n1,2,3,0,0,0\n").starts_with("line 2: n_x"));
    assert!(fault("1,2,3\n").contains("--columns"));
    assert!(fault("x,y,n_x\n1,2,3\n").contains("no column z"));
    assert!(fault("").contains("no line of names"));
    assert!(fault("x,y,z,x\n").contains("two columns"));
    let sized = RowOptions { size: Some([2, 1]), ..plain() };
    let fault = |text: &str| import_queries(text.as_bytes(), &sized).unwrap_err().to_string();
    assert_eq!(fault("x,y,z\n1,2,3\n1,2,3\n1,2,3\n"), "line 4: pixel 2 lies outside the image of 2x1");
    assert_eq!(
        fault("x,y,z,pixel\n1,2,3,0.5\n"),
        "line 2: pixel is `0.5`; a whole number of 0 to 4294967295 is needed"
    );
    assert!(
        fault("x,y,z,material,diffuse_r,diffuse_g,diffuse_b\n1,2,3,0,1,1,1\n1,2,3,0,1,1,0\n")
            .starts_with("line 3: material 0")
    );
}

#[test]
fn defaults_are_as_stated() {
    let queries = import_queries(b"x,y,z\n1,2,3\n4,5,6\n", &RowOptions { size: Some([2, 1]), ..plain() }).unwrap();
    assert_eq!(queries.iter().map(|q| (q.pixel, q.sample, q.material)).collect::<Vec<_>>(), [(0, 0, 0), (1, 1, 0)]);
    assert_eq!((queries[0].normal(), queries[0].view(), queries[0].weight), ([0., 1., 0.], [0., 1., 0.], [1.0; 3]));
    assert_eq!(import_queries(b"x,y,z\n1,2,3\n4,5,6\n", &plain()).unwrap()[1].pixel, 0);
    let photon = import_photons(b"x,y,z,from_x,from_y,from_z\n0,0,0,0,0,-7\n", &plain()).unwrap()[0];
    assert_eq!((photon.towards_source(), photon.normal(), photon.power()), ([0., 0., -1.], [0., 0., -1.], [1.0; 3]));
}

#[test]
fn bounds_and_materials_are_those_of_the_rows() {
    let text = b"x,y,z,diffuse_r,diffuse_g,diffuse_b\n1,-2,3,1,0,0\n4,5,-6,0,1,0\n0,0,0,1,0,0\n";
    let imported = queries(&text[..], &plain(), step()).unwrap();
    assert_eq!(imported.header.bounds, Bounds { min: [0., -2., -6.], max: [4., 5., 3.] });
    let colours: Vec<_> = imported.header.materials.iter().map(|material| material.diffuse).collect();
    assert_eq!(colours, [[1., 0., 0.], [0., 1., 0.]]);
    let materials: Vec<_> = records::<Query>(&imported.write(vec![]).unwrap()).iter().map(|q| q.material).collect();
    assert_eq!(materials, [0, 1, 0]);
}

proptest! {
    /// A photon as it is shown comes back: position and power bit by bit, directions but for the last digit, since those
    /// on an edge of the octahedron have two codes each.
    #[test]
    fn photons_come_back(position in proptest::array::uniform3(-1e6f32..1e6), power in proptest::array::uniform3(0f32..1e4),
                         seen in proptest::array::uniform3(-1f32..1.0), t in 0f32..1.0) {
        let photon = Photon::new(position, power, [t; 3], seen, [seen[1], -seen[0], seen[2]]).unwrap();
        let stream = {
            let mut writer = pm_formats::RecordWriter::<Photon, _>::new(vec![], &pm_formats::Header::empty()).unwrap();
            writer.write(pm_formats::BlockMeta::default(), &[photon]).unwrap();
            writer.finish(vec![]).unwrap()
        };
        let mut text = vec![];
        crate::records(pm_formats::BlockReader::new(&stream[..]).unwrap(), 9, &mut text).unwrap();
        let back = import_photons(&text, &plain()).unwrap()[0];
        prop_assert_eq!(back.position.map(f32::to_bits), photon.position.map(f32::to_bits));
        prop_assert_eq!(back.power(), photon.power());
        let near = |a: [f32; 3], b: [f32; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 3e-7);
        prop_assert!(near(back.normal(), photon.normal()));
        prop_assert!(near(back.towards_source(), photon.towards_source()));
    }
}
