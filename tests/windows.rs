//! Windows cut out of the stream: the very queries of the whole, in its order, each with its chance, and passed on?

use crate::streams::{check, records, searches};
use crate::support::{Folder, same_bytes};
use pm_formats::vocabulary::{meaning, measure};
use pm_formats::{BlockMeta, BlockReader, End, Header, Query, RecordReader};
use std::ops::Range;

/// A picture that sees the mirror and the glass sphere, in tiles that do not divide it.
const PICTURE: &str = "--size 23x17";

/// Orders whose windows are tried.
const ORDERS: [&str; 11] = [
    "--gathers 6",
    "--gathers 6 --strata shuffled",
    "--gathers 6 --order tiled --tile 5",
    "--gathers 6 --order tiled --tile 1 --samples 2",
    "--gathers 6 --order tiled --tile 99 --strata shuffled",
    "--gathers 6 --order direction-binned --tile 7",
    "--gathers 6 --order direction-binned --tile 7 --bins 4 --strata shuffled --samples 3",
    "--gathers 6 --order direction-binned --tile 99 --bins 5",
    "--samples 3 --gathers 7 --sampling uniform --min-gather-dist 0.1",
    "--direct-visualisation --order tiled --tile 4 --samples 2",
    "--gathers 9 --guide map.pmp --order direction-binned --tile 7",
];

/// A folder with the photons that guide.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.run("pm-photons -n 2000 -o map.pmp").ok();
    folder
}

/// A stream of queries: what it says of itself, and block by block what it holds.
struct Stream {
    header: Header,
    blocks: Vec<(BlockMeta, Vec<Query>)>,
    end: End,
}

impl Stream {
    fn of(folder: &Folder, line: &str) -> Self {
        Self::read(&folder.run(line).ok().stdout)
    }

    fn read(bytes: &[u8]) -> Self {
        let mut reader = RecordReader::<Query, _>::new(bytes).unwrap();
        let mut blocks = vec![];
        while let Some(block) = reader.next_block().unwrap() {
            blocks.push(block);
        }
        Self { header: reader.header().clone(), blocks, end: reader.end().unwrap().clone() }
    }

    fn meaning(&self, name: &str) -> &str {
        self.header.meaning(name).unwrap_or_else(|| panic!("no {name}"))
    }

    fn measure(&self, name: &str) -> f64 {
        self.end.measure(name).unwrap_or_else(|| panic!("no {name}")).as_f64()
    }

    /// All queries in order, of the blocks that are warm-up or of those that are not.
    fn queries(&self, warm_up: bool) -> Vec<Query> {
        let blocks = self.blocks.iter().filter(|(meta, _)| meta.warm_up == warm_up);
        blocks.flat_map(|(_, queries)| queries.clone()).collect()
    }

    /// Window by window its warm-up and its measured queries. Ids ascend, and warm-up comes first.
    fn windows(&self) -> Vec<(u64, Vec<Query>, Vec<Query>)> {
        let ids: Vec<(u64, bool)> = self.blocks.iter().map(|(meta, _)| (meta.batch, !meta.warm_up)).collect();
        assert!(ids.is_sorted(), "{ids:?}");
        let windows = self.blocks.chunk_by(|(a, _), (b, _)| a.batch == b.batch);
        let part = |blocks: &[(BlockMeta, Vec<Query>)], warm_up: bool| {
            let blocks = blocks.iter().filter(|(meta, _)| meta.warm_up == warm_up);
            blocks.flat_map(|(_, queries)| queries.clone()).collect()
        };
        windows.map(|blocks| (blocks[0].0.batch, part(blocks, true), part(blocks, false))).collect()
    }
}

/// The number that a refusal to give more names as the most.
fn at_most(message: &str) -> u64 {
    let (_, most) = message.split_once("give at most ").unwrap_or_else(|| panic!("{message}"));
    most.split(|c: char| !c.is_ascii_digit()).next().unwrap().parse().unwrap()
}

#[test]
fn all_windows_together_are_the_whole_stream() {
    let folder = folder();
    for order in ORDERS {
        let line = format!("pm-queries {PICTURE} {order}");
        let whole = Stream::of(&folder, &line);
        let (all, lost) = (whole.queries(false), whole.measure(measure::GATHER_RAYS_LOST));
        for length in [1, 13, 100, 1_000_000] {
            let refused = folder.run(&format!("{line} --window {length} --only-tiles 100000000"));
            let n = at_most(refused.fails(2));
            let line = format!("{line} --window {length} --only-tiles {n} --warm-up 0");
            let windows = Stream::of(&folder, &line);
            assert_eq!(windows.queries(false).len(), all.len(), "{line}");
            assert!(windows.queries(false) == all, "{line}");
            assert!(windows.queries(true).is_empty());
            assert_eq!(windows.meaning(meaning::SAMPLE_WINDOWS), n.to_string());
            assert_eq!(windows.meaning(meaning::SAMPLE_SHARE), "1");
            assert_eq!(windows.measure(measure::EYE_RAYS), whole.measure(measure::EYE_RAYS), "{line}");
            if !order.contains("visualisation") {
                assert_eq!(windows.measure(measure::GATHER_RAYS), whole.measure(measure::GATHER_RAYS), "{line}");
                assert_eq!(windows.measure(measure::GATHER_RAYS_LOST), lost, "{line}");
            }
        }
        // So are all its batches.
        let n = at_most(folder.run(&format!("{line} --only-tiles 100000000")).fails(2));
        let line = format!("{line} --only-tiles {n}");
        let batches = Stream::of(&folder, &line);
        assert!(batches.blocks == whole.blocks, "{line}");
        assert_eq!(
            [batches.meaning(meaning::SAMPLE_WINDOWS), batches.meaning(meaning::SAMPLE_SHARE)],
            [&n.to_string(), "1"]
        );
    }
}

/// The queries of the rays with these numbers; `by_ray` has the number of each query's ray.
fn of_rays(by_ray: &[(u64, Query)], rays: Range<u64>) -> Vec<Query> {
    by_ray.iter().filter(|(ray, _)| rays.contains(ray)).map(|&(_, query)| query).collect()
}

#[test]
fn windows_are_cells_of_their_strata_and_what_comes_before() {
    let folder = folder();
    let (length, warm_up, n) = (13, 9, 20);
    for order in ORDERS {
        let line = format!("pm-queries {PICTURE} {order}");
        // Windows of one ray number the rays.
        let rays = at_most(folder.run(&format!("{line} --window 1 --only-tiles 100000000")).fails(2));
        let numbered = Stream::of(&folder, &format!("{line} --window 1 --warm-up 0 --only-tiles {rays}"));
        let by_ray: Vec<(u64, Query)> =
            numbered.windows().iter().map(|(ray, _, measured)| (*ray, measured[0])).collect();

        let line = format!("{line} --window {length} --warm-up {warm_up} --only-tiles {n}");
        let mut measured_rays = 0;
        let mut choices = vec![];
        for seed in 0..5 {
            let sample = Stream::of(&folder, &format!("{line} --sample-seed {seed}"));
            let mut chosen = vec![];
            for (stratum, before, measured) in sample.windows() {
                // A window whose rays are all lost is not in the stream, and one that is there has a query by which to
                // know its cell, be it of the warm-up.
                let ray_of = |query: &Query| by_ray.iter().find(|(_, known)| known == query).expect("the same query").0;
                let cell = match measured.first() {
                    Some(query) => ray_of(query) / length,
                    None => ray_of(&before[0]).div_ceil(length),
                };
                let cells = rays.div_ceil(length);
                assert!(
                    (stratum * cells / n..(stratum + 1) * cells / n).contains(&cell),
                    "{line}: {cell} in {stratum}"
                );
                let start = cell * length;
                assert!(measured == of_rays(&by_ray, start..start + length), "{line}: window {stratum}");
                assert!(before == of_rays(&by_ray, start.saturating_sub(warm_up)..start), "{line}: window {stratum}");
                chosen.push(cell);
            }
            assert!(chosen.len() > n as usize / 2, "{line}: {} windows", chosen.len());
            assert_eq!(sample.meaning(meaning::SAMPLE_WINDOWS), "20");
            assert_eq!(sample.meaning(meaning::SAMPLE), "20 windows of 13 rays after 9");
            let queries: usize = sample.blocks.iter().map(|(_, queries)| queries.len()).sum();
            assert!(sample.header.expected_records >= Some(queries as u64), "{line}: more than expected");
            let share: f64 = sample.meaning(meaning::SAMPLE_SHARE).parse().unwrap();
            assert_eq!(
                share,
                sample.measure(measure::GATHER_RAYS_MEASURED) / sample.measure(measure::GATHER_RAYS_OF_ALL)
            );
            measured_rays += sample.measure(measure::GATHER_RAYS_MEASURED) as u64;
            assert_eq!(sample.measure(measure::GATHER_RAYS_OF_ALL), rays as f64);
            choices.push(chosen);
        }
        // Only the last cell can be shorter.
        assert!((5 * n * length - 5 * length..=5 * n * length).contains(&measured_rays), "{line}: {measured_rays}");
        choices.dedup();
        assert!(choices.len() > 3, "{line}: seeds change little");
    }
}

#[test]
fn tiles_at_the_source_are_those_of_the_whole() {
    let folder = Folder::new();
    for order in ["--order tiled --tile 5", "--order direction-binned --tile 5 --bins 3", ""] {
        let line = format!("pm-queries {PICTURE} --gathers 6 {order}");
        let whole = Stream::of(&folder, &line);
        let batches = at_most(folder.run(&format!("{line} --only-tiles 1000000")).fails(2));
        let n = batches / 3;
        let tiles = Stream::of(&folder, &format!("{line} --only-tiles {n}"));
        let mut at = 0;
        for (stratum, before, measured) in tiles.windows() {
            let batch = measured_batch(&whole, &measured);
            assert!((stratum * batches / n..(stratum + 1) * batches / n).contains(&batch), "{line}: {batch}");
            assert!(before.is_empty() && (batch > at || at == 0));
            at = batch;
        }
        assert!(
            tiles.measure(measure::EYE_RAYS) < 0.5 * whole.measure(measure::EYE_RAYS),
            "{line}: rays that nobody needs"
        );
        assert_eq!(tiles.meaning(meaning::SAMPLE), format!("{n} of {batches} batches"));
        assert_eq!(tiles.meaning(meaning::SAMPLE_SHARE).parse::<f64>().unwrap(), n as f64 / batches as f64);
        let other = Stream::of(&folder, &format!("{line} --only-tiles {n} --sample-seed 1"));
        assert!(other.blocks != tiles.blocks, "{line}: the seed changes nothing");
    }
}

/// The batch of the whole stream that consists of these queries.
fn measured_batch(whole: &Stream, queries: &[Query]) -> u64 {
    let batch = whole.windows().into_iter().find(|(_, _, batch)| batch == queries);
    batch.expect("these queries are a batch of the whole").0
}

#[test]
fn samples_at_the_source_do_not_depend_on_threads() {
    let folder = folder();
    for order in ORDERS {
        for part in ["--only-tiles 1", "--only-tiles 9 --window 40"] {
            // The only tile chosen may see nothing, which is worth a remark.
            let line = format!("pm-queries {PICTURE} {order} {part} -q");
            let one = folder.run(&line).ok().stdout;
            for threads in [2, 5] {
                let many = folder.run(&format!("{line} -t {threads}")).ok().stdout;
                same_bytes(&format!("`{line}` with {threads} threads"), &one, &many);
            }
        }
    }
}

#[test]
fn windows_cut_later_are_the_queries_that_stand_there() {
    let folder = Folder::new();
    folder.run(&format!("pm-queries {PICTURE} --gathers 64 --order tiled --tile 16 -o q.pmq")).ok();
    let all = folder.read("q.pmq");
    let queries = records::<Query>(&all);
    // Windows are cut within blocks and across them, and across batches.
    let longest = Stream::read(&all).windows().iter().map(|(_, _, batch)| batch.len()).max();
    assert!(longest > Some(pm_formats::BLOCK_RECORDS), "{longest:?} queries");
    for (every, window, warm_up, seed) in
        [(1000, 50, 64, 0), (1000, 50, 64, 1), (90, 30, 70, 2), (5000, 1000, 2000, 3), (7, 7, 0, 0), (100, 1, 0, 4)]
    {
        let line = format!("pm-sample --every {every} --window {window} --warm-up {warm_up} --seed {seed} q.pmq");
        let sample = Stream::of(&folder, &line);
        let mut measured_places = 0;
        let mut before_them = 0;
        for (stratum, before, measured) in sample.windows() {
            let stratum = stratum as usize * every;
            let starts = (stratum..stratum + every).step_by(window);
            let mut starts = starts.filter(|&start| queries.get(start) == measured.first());
            let start = starts.next().unwrap_or_else(|| panic!("{line}: no cell of its stratum"));
            assert!(measured == queries[start..queries.len().min(start + window)], "{line}");
            assert!(before == queries[start.saturating_sub(warm_up)..start], "{line}");
            measured_places += measured.len();
            before_them += before.len();
        }
        assert_eq!(sample.measure(measure::QUERIES_KEPT), measured_places as f64);
        assert_eq!(sample.measure(measure::QUERIES_OF_WARM_UP), before_them as f64);
        assert_eq!(sample.measure(measure::QUERIES_GIVEN), queries.len() as f64);
        assert_eq!(sample.measure(measure::SHARE), measured_places as f64 / queries.len() as f64);
        // A window of the last stratum may lie beyond the end of the stream.
        let (windows, strata) = (sample.windows().len(), queries.len().div_ceil(every));
        assert!(windows == strata || windows + 1 == strata, "{line}: {windows} windows");
        assert_eq!(sample.measure(measure::WINDOWS), strata as f64);
        assert_eq!(sample.meaning(meaning::SAMPLE_WINDOWS), "0");
        assert_eq!(sample.meaning(meaning::SAMPLE_SHARE).parse::<f64>().unwrap(), window as f64 / every as f64);
        assert!(measured_places.abs_diff(queries.len() * window / every) <= window, "{line}: {measured_places}");
    }
    // One of one is everything, in order.
    let whole = Stream::of(&folder, "pm-sample --every 7 --window 7 --warm-up 0 q.pmq");
    assert!(whole.queries(false) == queries);
    let kept = |seed| Stream::of(&folder, &format!("pm-sample --every 100 --window 10 --seed {seed} q.pmq")).blocks;
    assert!(kept(0) != kept(1), "the seed changes nothing");
    // From a pipe as from a file.
    let line = "pm-sample --every 100 --window 10";
    assert!(Stream::read(&folder.feed(line, &all).ok().stdout).blocks == kept(0));
}

#[test]
fn windows_go_through_the_pipe_one_by_one() {
    let folder = folder();
    let tiled = format!("pm-queries {PICTURE} --gathers 6 --order tiled --tile 5");
    folder.run(&format!("{tiled} --only-tiles 9 --window 40 --warm-up 30 -o windows.pmq")).ok();
    folder.run(&format!("{tiled} --only-tiles 6 -o tiles.pmq")).ok();
    folder.run(&format!("{tiled} -o all.pmq")).ok();

    // Whole tiles reordered are tiles of the reordered whole.
    let whole = Stream::of(&folder, "pm-reorder hilbert --per batch all.pmq");
    let tiles = Stream::of(&folder, "pm-reorder hilbert --per batch tiles.pmq");
    for (_, _, tile) in tiles.windows() {
        let _ = measured_batch(&whole, &tile);
    }
    let given = Stream::read(&folder.read("windows.pmq"));
    for order in ["hilbert", "hashed --buckets 5 --capacity 4", "snowplow --storage 2K", "buffered", "random"] {
        let outcome = folder.run(&format!("pm-reorder {order} --per batch windows.pmq -o reordered.pmq"));
        assert!(outcome.fails(0).contains("is not the order of all"), "{}", outcome.stderr);
        let reordered = Stream::read(&folder.read("reordered.pmq"));
        let sorted = |mut queries: Vec<Query>| {
            queries.sort_by_key(|query| (query.pixel, query.sample));
            queries
        };
        let sorted =
            |(window, before, measured): (u64, Vec<Query>, Vec<Query>)| (window, sorted(before), sorted(measured));
        assert!(
            reordered.windows().into_iter().map(sorted).eq(given.windows().into_iter().map(sorted)),
            "{order} mixes windows"
        );
        // The trace has the same windows, and its header says so.
        folder.run("pm-gather map.pmp reordered.pmq -k 20 -t 2 -o t.pmt").ok();
        let trace = folder.read("t.pmt");
        let mut blocks = BlockReader::new(&trace[..]).unwrap();
        for name in [meaning::SAMPLE, meaning::SAMPLE_OF, meaning::SAMPLE_WINDOWS, meaning::SAMPLE_SHARE] {
            assert_eq!(blocks.header().meaning(name), Some(given.meaning(name)), "{name}");
        }
        let mut metas = vec![];
        while let Some(block) = blocks.next_block().unwrap() {
            metas.push(block.meta);
        }
        let expected: Vec<BlockMeta> = reordered.blocks.iter().map(|(meta, _)| *meta).collect();
        assert_eq!(metas, expected, "{order}");
        assert!(metas.iter().any(|meta| meta.warm_up) && metas.iter().any(|meta| !meta.warm_up));
    }
}

#[test]
fn a_search_takes_nothing_over_from_another_window() {
    let folder = folder();
    let tiled = format!("pm-queries {PICTURE} --gathers 6 --order tiled --tile 5");
    folder.run(&format!("{tiled} -o all.pmq")).ok();
    folder.run(&format!("{tiled} --only-tiles 6 -o tiles.pmq")).ok();
    let searches_of =
        |name: &str| searches(&folder.run(&format!("pm-gather map.pmp {name} -k 20 --carry")).ok().stdout);
    let (all, some) = (searches_of("all.pmq"), searches_of("tiles.pmq"));
    let batches: Vec<_> = all.chunk_by(|a, b| a.batch == b.batch).collect();
    for tile in some.chunk_by(|a, b| a.batch == b.batch) {
        let same = |batch: &&[crate::streams::Search]| {
            batch
                .iter()
                .map(|search| (&search.pixels, &search.accesses))
                .eq(tile.iter().map(|search| (&search.pixels, &search.accesses)))
        };
        assert!(batches.iter().any(same), "tile {} reads otherwise than in the whole", tile[0].batch);
    }
}

#[test]
fn what_no_sample_can_do_is_refused() {
    let folder = Folder::with_streams();
    folder.run("pm-queries --size 16x12 --gathers 4 --only-tiles 3 --window 9 -o windows.pmq").ok();
    folder.run("pm-reorder hilbert q.pmq -o h.pmq").ok();
    for (line, named) in [
        ("pm-queries --only-tiles 2 --base b.exr", "--base"),
        ("pm-queries --only-tiles 2 --irradiance-cache 0.1", "--irradiance-cache"),
        ("pm-queries --window 20", "--only-tiles"),
        ("pm-queries --only-tiles 2 --warm-up 20", "--window"),
        ("pm-queries --sample-seed 2", "--only-tiles"),
        ("pm-queries --only-tiles 0", "--only-tiles"),
        ("pm-queries --only-tiles 2 --window 0", "--window"),
        ("pm-queries --size 16x12 --only-tiles 13", "12 batches (tiles or scanlines): give at most 12"),
        ("pm-queries --size 16x12 --only-tiles 9 --window 9999999", "give at most 1"),
        ("pm-sample --every 100 q.pmq", "--window"),
        ("pm-sample --window 100 q.pmq", "--every"),
        ("pm-sample --warm-up 9 --batches 3 q.pmq", "--every"),
        ("pm-sample --every 10 --window 3 q.pmq", "9 or 12 would do"),
        ("pm-sample --every 2 --window 3 q.pmq", "3 or 6 would do"),
        ("pm-sample --every 10 --window 5 windows.pmq", "a sample already (3 windows of 9 rays after 64)"),
        ("pm-sample --queries 2 windows.pmq", "a sample already"),
        ("pm-reorder hilbert windows.pmq", "give --per batch"),
        ("pm-gather map.pmp windows.pmq --image out.exr", "leave out --image"),
    ] {
        let outcome = folder.run(line);
        assert!(outcome.code == 2 && outcome.stdout.is_empty(), "`{line}`: {outcome:?}");
        assert!(outcome.stderr.contains(named), "`{line}` should say `{named}`:\n{}", outcome.stderr);
    }
    // Nor is a share of the batches a picture.
    folder.run("pm-sample --batches 2 q.pmq -o half.pmq").ok();
    assert!(folder.run("pm-gather map.pmp half.pmq --image out.exr").fails(2).contains("1 of 2 batches"));
    // A sample without a window would be an answer from nothing.
    assert!(folder.run("pm-sample --every 1000000 --window 10 q.pmq").fails(1).contains("a smaller --every"));
    // Whole-image orders are one batch: it is done, and said.
    let outcome = folder.run("pm-sample --every 100 --window 10 h.pmq");
    assert!(outcome.fails(0).contains("--queries thins"), "{}", outcome.stderr);
    check(&outcome.stdout).unwrap();
    assert_eq!(folder.names(), ["h.pmq", "half.pmq", "map.pmp", "q.pmq", "windows.pmq"]);
}

#[test]
fn samples_of_nothing_are_empty_streams() {
    let folder = Folder::new();
    let blind = "pm-queries --size 8x8 --gathers 4 --eye 0,0,100 --look-at 0,0,200 -q";
    for part in ["--only-tiles 2", "--only-tiles 2 --window 5"] {
        let stream = folder.run(&format!("{blind} {part}")).ok().stdout;
        assert_eq!(check(&stream).unwrap().records, 0);
        let sampled = folder.run(&format!("{blind} -o none.pmq"));
        assert_eq!(sampled.code, 0);
        assert_eq!(check(&folder.run("pm-sample --every 10 --window 5 none.pmq").ok().stdout).unwrap().records, 0);
    }
}

#[test]
fn tables_beside_the_queries_go_with_windows() {
    let folder = folder();
    folder.run("pm-queries --size 24x16 --gathers 9 --irradiance-cache 0.2 -o cached.pmq").ok();
    folder.run("pm-sample --every 200 --window 20 cached.pmq -o windows.pmq").ok();
    // The searches for records need the tables.
    let trace = folder.run("pm-gather map.pmp windows.pmq -k 20").ok().stdout;
    assert_eq!(check(&trace).unwrap().records, records::<Query>(&folder.read("windows.pmq")).len() as u64);
}
