//! Parts of small streams: which are put together, and which are refused?

use super::*;
use crate::container::{BlockMeta, BlockWriter, Number, StageReport};
use crate::history::Step;
use crate::record::{Query, encode_records};
use crate::trace::{Access, TraceSink};
use crate::vocabulary::{Part, meaning, measure};

struct Nobody;

impl TraceSink for Nobody {
    fn access(&mut self, _: Access) {}
}

fn query(pixel: u32) -> Query {
    let (normal, view) = Query::pack_vectors([0.0, 1.0, 0.0], [0.0, 0.6, 0.8]);
    let position = [pixel as f32, 0.0, 1.0];
    Query { position, normal, view, material: 0, flags: 0, pixel, sample: 0, weight: [0.5; 3] }
}

fn header(part: Option<Part>, input: Option<&str>) -> Header {
    let mut arguments: Vec<String> = vec!["-n".into(), "5".into()];
    arguments.extend(part.iter().flat_map(|part| ["--part".to_owned(), part.to_string()]));
    let step = |program: &str, arguments, input: Option<&str>| Step {
        program: program.into(),
        version: "1".into(),
        arguments,
        seed: Some(0),
        input: input.map(str::to_owned),
        inputs: vec![],
    };
    let history = vec![
        step("pm-queries", arguments, None),
        step("pm-reorder", input.iter().map(|name| (*name).to_owned()).collect(), input),
    ];
    let floor = crate::Material { name: "a".into(), diffuse: [0.5; 3], specular: [0.0; 3], exponent: 0.0 };
    let mut header = Header { image: [9, 9], materials: vec![floor], history, ..Header::empty() };
    header.set_meaning(meaning::ORDER, "tiled 3x3");
    part.into_iter().for_each(|part| header.set_meaning(meaning::PART, part));
    header
}

/// Batches 0 to 8 of a few queries each, or those of a part; batches 3 and 6 have none.
fn stream(header: &Header, part: Option<Part>) -> Vec<u8> {
    let mut writer = BlockWriter::new(vec![], StreamKind::Queries, header).unwrap();
    let mut end = End::default();
    let mut rays = 0;
    for batch in (0..9u32).filter(|batch| batch % 3 != 0 || *batch == 0) {
        if part.is_some_and(|part| !part.has(batch.into())) {
            continue;
        }
        for block in 0..2 {
            let records: Vec<Query> = (0..4).map(|i| query(batch * 9 + block * 4 + i)).collect();
            let meta = BlockMeta { batch: batch.into(), ..BlockMeta::default() };
            let (block, tally) = encode_records(meta, &records).unwrap();
            writer.write(&block).unwrap();
            end.tally += tally;
        }
        rays += 8;
    }
    let stage = StageReport::new("pm-queries").with(measure::EYE_RAYS, Number::Count(rays));
    let reorder = StageReport::new("pm-reorder").with(measure::ON_CHIP, Number::Bytes(if rays > 0 { 7 } else { 0 }));
    end.stages = vec![stage.with("made", Number::Real(0.5)), reorder];
    writer.finish(&end).unwrap()
}

fn part(number: u64, of: u64) -> Vec<u8> {
    let part = Part::new(number, of);
    stream(&header(part, None), part)
}

fn together(parts: &[Vec<u8>]) -> Result<Vec<u8>, PartsError> {
    let named = parts.iter().enumerate();
    let opened = named.map(|(at, bytes)| (format!("p{at}"), BlockReader::new(&bytes[..]).unwrap())).collect();
    let mut parts = Parts::new(opened)?;
    let mut writer = BlockWriter::new(vec![], parts.kind(), parts.header()).unwrap();
    while let Some(block) = parts.next_block(&mut Nobody)? {
        writer.write(&block).unwrap();
    }
    Ok(writer.finish(&parts.end()?).unwrap())
}

fn refused(parts: &[Vec<u8>]) -> String {
    together(parts).expect_err("they are no whole").to_string()
}

#[test]
fn parts_in_any_order_are_the_whole_byte_for_byte() {
    let whole = stream(&header(None, None), None);
    for of in [1, 2, 3, 8, 20] {
        let mut parts: Vec<_> = (1..=of).map(|number| part(number, of)).collect();
        assert_eq!(together(&parts).unwrap(), whole, "{of} parts");
        parts.reverse();
        assert_eq!(together(&parts).unwrap(), whole, "{of} parts, the last first");
    }
}

#[test]
fn files_on_the_way_are_a_pipe_where_their_names_differ() {
    let with = |name: [&str; 2]| {
        let parts = [1, 2].map(|number| Part::new(number, 2));
        let parts = [0, 1].map(|at| stream(&header(parts[at], Some(name[at])), parts[at]));
        together(&parts)
    };
    assert_eq!(with(["a.pmq", "b.pmq"]).unwrap(), stream(&header(None, None), None));
    assert_eq!(with(["a.pmq", "a.pmq"]).unwrap(), stream(&header(None, Some("a.pmq")), None));
}

#[test]
fn what_is_not_all_parts_of_one_stream_is_refused() {
    assert_eq!(refused(&[]), "no part is given");
    assert_eq!(refused(&[part(1, 3), part(3, 3)]), "part 2/3 is missing");
    assert_eq!(refused(&[part(3, 8)]), "7 parts are missing, the first of them 1/8");
    assert_eq!(refused(&[part(1, 2), part(1, 2), part(2, 2)]), "p0 and p1 are both part 1/2: give each once");
    assert_eq!(refused(&[part(1, 2), part(2, 3)]), "p1 is part 2/3, but p0 is one of 2");
    let whole = stream(&header(None, None), None);
    assert!(refused(&[whole]).starts_with("p0: not a part of a stream, but a whole one"));
    let other = |change: &dyn Fn(&mut Header)| {
        let two = Part::new(2, 2);
        let mut changed = header(two, None);
        change(&mut changed);
        refused(&[part(1, 2), stream(&changed, two)])
    };
    let said = "p0 and p1 are parts of two streams: ";
    assert_eq!(other(&|header| header.image = [9, 10]), format!("{said}their images differ"));
    assert_eq!(other(&|header| header.bounds.min = [0.0; 3]), format!("{said}their bounds differ"));
    assert_eq!(other(&|header| header.set_meaning(meaning::ORDER, "tiled 4x4")), format!("{said}`order` differ"));
    let said = "p0 and p1 were not made in the same way: ";
    let argued = other(&|header| header.history[0].arguments[1] = "6".into());
    assert_eq!(argued, format!("{said}`pm-queries -n 5` and `pm-queries -n 6`"));
    let versions = other(&|header| header.history[1].version = "2".into());
    assert_eq!(versions, format!("{said}`pm-reorder (version 1)` and `pm-reorder (version 2)`"));
    assert!(other(&|header| header.history[0].seed = Some(1)).starts_with(said));
    assert_eq!(other(&|header| header.history.truncate(1)), "p0 and p1 went through different programs");
}

#[test]
fn a_part_with_batches_of_others_or_out_of_order_is_damaged() {
    // The blocks of part 1, said to be of part 2.
    let (one, two) = (Part::new(1, 2), Part::new(2, 2));
    let foreign = stream(&header(two, None), one);
    assert!(refused(&[part(1, 2), foreign]).contains("a batch that another part has"));
    let mut whole = BlockReader::new(&part(1, 1)[..]).map(|mut reader| {
        let mut blocks = vec![];
        while let Some(block) = reader.next_block().unwrap() {
            blocks.push(block);
        }
        blocks
    });
    let blocks = whole.as_mut().unwrap();
    blocks.rotate_left(2);
    let mut writer = BlockWriter::new(vec![], StreamKind::Queries, &header(Part::new(1, 1), None)).unwrap();
    blocks.iter().for_each(|block| writer.write(block).unwrap());
    let tally = crate::RecordReader::<Query, _>::new(&part(1, 1)[..]).map(|mut reader| {
        while reader.next_block().unwrap().is_some() {}
        reader.tally()
    });
    let end = End { tally: tally.unwrap(), ..End::default() };
    assert!(refused(&[writer.finish(&end).unwrap()]).contains("out of order"));
    let mut cut = part(2, 2);
    cut.truncate(cut.len() - 1);
    assert!(refused(&[part(1, 2), cut]).contains("stops before its end block"));
}

#[test]
fn measures_are_added_where_they_are_sums() {
    let (name, sum) = (measure::GATHER_RAYS, Number::Count);
    let of = |stages: Vec<StageReport>| End { stages, ..End::default() };
    let stage = |numbers: &[(&str, Number)]| {
        of(vec![numbers.iter().fold(StageReport::new("x"), |stage, (name, number)| stage.with(name, *number))])
    };
    let whole = |parts: &[End]| end::whole_stages(&parts.iter().map(|end| ("p", end)).collect::<Vec<_>>());
    let found = whole(&[stage(&[(name, sum(1))]), stage(&[(name, sum(2)), (measure::EYE_RAYS_AGAIN, sum(4))])]);
    assert_eq!(found.unwrap(), stage(&[(name, sum(3)), (measure::EYE_RAYS_AGAIN, sum(4))]).stages);
    let greatest = |bytes| stage(&[(measure::ON_CHIP, Number::Bytes(bytes))]);
    assert_eq!(whole(&[greatest(5), greatest(9), greatest(2)]).unwrap(), greatest(9).stages);
    // Windows of rays: all eye rays are cast in each part, to know where they lie.
    let windows = |rays| stage(&[(measure::EYE_RAYS, sum(rays)), (measure::GATHER_RAYS_OF_ALL, sum(100))]);
    assert_eq!(whole(&[windows(7), windows(7)]).unwrap(), windows(7).stages);
    for odd in [
        [windows(7), windows(8)],
        [stage(&[(name, sum(u64::MAX))]), stage(&[(name, sum(1))])],
        [stage(&[(name, sum(1))]), stage(&[(name, Number::Bytes(1))])],
        [stage(&[("a", sum(1))]), stage(&[("b", sum(1))])],
        [stage(&[]), of(vec![])],
    ] {
        assert!(whole(&odd).is_err(), "{odd:?}");
    }
}
