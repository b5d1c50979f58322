//! What a point runs: the streams that are made first, and the command that prints its row.

use crate::make::escaped;
use crate::names::{misread_in_prerequisite, slug};
use crate::stage::{OUT, PHOTONS, QUERIES};
use crate::{Stage, Stream, Work};
use std::collections::BTreeMap;

/// Where what points have in common lies.
const STREAMS: &str = "out/streams";

/// The number of threads, which changes no byte of a stream and belongs to make.
const THREADS: &str = "-t $(THREADS)";

/// Texts of the stages of one point, without those that are empty.
pub(crate) type Texts = BTreeMap<Stage, String>;

/// What a point runs. Its command still has `{out}` in it.
pub(crate) fn work(texts: &Texts) -> Result<Work, String> {
    let text = |stage: Stage| texts.get(&stage).map_or("", |text| text.trim());
    let scene_files = scene_files(text(Stage::Scene))?;
    let mut pipe = Pipe { scene: text(Stage::Scene), scene_files, streams: vec![] };
    let photons_file = format!("{STREAMS}/{}.pmp", slug(&with(pipe.scene, text(Stage::Photons), " ")));
    let photons_name = slug(text(Stage::Photons));

    let stream = text(Stage::Stream);
    for (stage, text) in [(Stage::Photons, text(Stage::Photons)), (Stage::Stream, stream)] {
        if text.contains("||") {
            return Err(format!("|| keeps queries, and stands in their column only, not in `{stage:?}`").to_lowercase());
        }
    }
    let gathers = match (texts.get(&Stage::Command), stream) {
        (Some(_), _) => None,
        (None, "") => Some(gather(texts, format!("pm-gather -q {{{PHOTONS}}} {{{QUERIES}}} {THREADS}"))),
        (None, _) => {
            Some(gather(texts, format!("< {{{QUERIES}}} {} | pm-gather -q {{{PHOTONS}}} {THREADS}", escaped(stream))))
        }
    };
    let command = match &gathers {
        Some(gathers) => format!("{gathers} | {}", cachesim(texts)),
        None => escaped(text(Stage::Command)),
    };
    let mut needs = files(text(Stage::Needs))?;
    let (uses_photons, uses_queries) = uses(&command, text(Stage::Queries));
    if uses_photons {
        needs.push(photons_file.clone());
        let needs = pipe.scene_files.clone();
        pipe.stream(&photons_file, needs, "pm-photons", text(Stage::Photons));
    }
    let queries_file =
        if uses_queries { pipe.queries(text(Stage::Queries), &photons_name, &photons_file)? } else { String::new() };
    if uses_queries {
        needs.push(queries_file.clone());
    }
    let in_files = |command: &str| filled(&filled(command, PHOTONS, &photons_file), QUERIES, &queries_file);
    let (command, gathers) = (in_files(&command), gathers.as_deref().map(in_files));
    Ok(Work { streams: pipe.streams, needs, command, gathers })
}

/// Whether a command, and the queries if it uses them, use the photons; and whether it uses the queries.
pub(crate) fn uses(command: &str, queries: &str) -> (bool, bool) {
    let has = |text: &str, name: &str| text.contains(&format!("{{{name}}}"));
    let uses_queries = has(command, QUERIES);
    (has(command, PHOTONS) || uses_queries && has(queries, PHOTONS), uses_queries)
}

/// A command with the name of the target, as far as it has no ending.
pub(crate) fn for_target(command: &str, target: &str) -> String {
    filled(command, OUT, target)
}

fn filled(text: &str, name: &str, by: &str) -> String {
    text.replace(&format!("{{{name}}}"), by)
}

fn gather(texts: &Texts, program: String) -> String {
    with(&program, &options(texts, Stage::Gather), " ")
}

fn cachesim(texts: &Texts) -> String {
    with("pm-cachesim -q --format csv", &options(texts, Stage::Cache), " ")
}

fn options(texts: &Texts, stage: Stage) -> String {
    texts.get(&stage).map_or(String::new(), |text| escaped(text.trim()))
}

/// Lets points that differ only in what simulates caches share one trace, which becomes a stream of theirs. It is read from
/// standard input, so that rows are as if it had been piped.
pub(crate) fn share_traces<'a>(works: impl Iterator<Item = &'a mut Work>) {
    let mut alike: BTreeMap<_, Vec<&mut Work>> = BTreeMap::new();
    for work in works {
        if let Some(gathers) = work.gathers.clone() {
            alike.entry((gathers, work.needs.clone())).or_default().push(work);
        }
    }
    for ((gathers, needs), works) in alike.into_iter().filter(|(_, works)| works.len() > 1) {
        // What all of them have is left out of the name.
        let said = [format!("{STREAMS}/").as_str(), "pm-gather -q", THREADS]
            .iter()
            .fold(gathers.clone(), |said, all| said.replace(all, ""));
        let file = format!("{STREAMS}/{}.pmt", slug(&said));
        for work in works {
            let trace = Stream { file: file.clone(), needs: needs.clone(), command: gathers.clone() };
            let simulates = work.command[gathers.len()..].trim_start_matches(" | ").to_owned();
            // Some of what gathering needs may be named to the simulation as well.
            work.needs.retain(|file| simulates.contains(file.as_str()));
            work.needs.push(file.clone());
            work.streams.push(trace);
            work.command = format!("< {file} {simulates}");
            work.gathers = None;
        }
    }
}

/// Two texts with something between them, if there are two.
pub(crate) fn with(text: &str, more: &str, between: &str) -> String {
    if text.is_empty() || more.is_empty() { format!("{text}{more}") } else { format!("{text}{between}{more}") }
}

/// Streams on the way.
struct Pipe<'a> {
    scene: &'a str,
    scene_files: Vec<String>,
    streams: Vec<Stream>,
}

impl Pipe<'_> {
    /// A stream of a program; what its options are piped through comes behind.
    fn stream(&mut self, file: &str, needs: Vec<String>, program: &str, options: &str) {
        let (options, pipe) = options.split_at(options.find('|').unwrap_or(options.len()));
        let scene = with(self.scene, options.trim(), " ");
        let command = with(&with(&format!("{program} -q"), &escaped(&scene), " "), THREADS, " ");
        let command = with(&command, &escaped(pipe), " ");
        self.streams.push(Stream { file: file.into(), needs, command });
    }

    /// The stream of queries, and the one that it begins with if that is kept; its file.
    fn queries(&mut self, queries: &str, photons_name: &str, photons_file: &str) -> Result<String, String> {
        // What guides gather rays is in the name too.
        let name = |queries: &str| slug(&with(self.scene, &filled(queries, PHOTONS, photons_name), " "));
        let file = |queries: &str| format!("{STREAMS}/{}.pmq", name(queries));
        let needs = |files: &[String], text: &str| {
            let (photons, _) = uses(text, "");
            files.iter().cloned().chain(photons.then(|| photons_file.to_owned())).collect::<Vec<_>>()
        };
        let whole = file(queries);
        let Some((first, then)) = queries.split_once("||") else {
            let needs = needs(&self.scene_files, queries);
            self.stream(&whole, needs, "pm-queries", &filled(queries, PHOTONS, photons_file));
            return Ok(whole);
        };
        if then.contains("||") {
            return Err("|| stands twice: queries are kept at one place only".into());
        }
        let kept = file(first);
        let (kept_needs, then_needs) = (needs(&self.scene_files, first), needs(std::slice::from_ref(&kept), then));
        self.stream(&kept, kept_needs, "pm-queries", &filled(first, PHOTONS, photons_file));
        let command = format!("< {kept} {}", escaped(filled(then, PHOTONS, photons_file).trim()));
        self.streams.push(Stream { file: whole.clone(), needs: then_needs, command });
        Ok(whole)
    }
}

/// The OBJ file of a scene.
fn scene_files(scene: &str) -> Result<Vec<String>, String> {
    let words = words(scene)?;
    if let Some(first) = words.first().filter(|first| !first.starts_with('-') && !first.ends_with(".obj")) {
        return Err(format!(
            "`{first}` is no OBJ file, which comes first in a scene; one with blanks stands in quotes"
        ));
    }
    let files: Vec<String> = words.into_iter().filter(|word| word.ends_with(".obj")).collect();
    match &files[..] {
        [_, second, ..] => {
            Err(format!("a scene is one OBJ file, and `{second}` is a second; one with blanks stands in quotes"))
        }
        _ => readable(files),
    }
}

/// Files that a cell lists.
fn files(text: &str) -> Result<Vec<String>, String> {
    readable(words(text)?)
}

fn readable(files: Vec<String>) -> Result<Vec<String>, String> {
    match files.iter().find_map(|file| Some((file, misread_in_prerequisite(file)?))) {
        Some((file, letter)) => {
            Err(format!("`{file}`: make would misread a file with {letter} in its name; rename it"))
        }
        None => Ok(files),
    }
}

fn words(text: &str) -> Result<Vec<String>, String> {
    shlex::split(text).ok_or_else(|| format!("`{text}`: a quote is not closed"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(cells: &[(Stage, &str)]) -> Result<Work, String> {
        work(&cells.iter().map(|(stage, text)| (*stage, (*text).to_owned())).collect())
    }

    #[test]
    fn the_plain_pipe() {
        let cells =
            [(Stage::Scene, "s.obj --glossy"), (Stage::Photons, "-n 5"), (Stage::Queries, "--size 8x8 | pm-sample")];
        let work = made(&[&cells[..], &[(Stage::Gather, "-k 5"), (Stage::Cache, "--sizes 4K")]].concat()).unwrap();
        let (map, queries) = ("out/streams/s.obj-glossy-n-5.pmp", "out/streams/s.obj-glossy-size-8x8-pm-sample.pmq");
        assert_eq!(work.needs, [map, queries]);
        let gather = format!("pm-gather -q {map} {queries} -t $(THREADS) -k 5");
        assert_eq!(work.command, format!("{gather} | pm-cachesim -q --format csv --sizes 4K"));
        let commands: Vec<&str> = work.streams.iter().map(|stream| stream.command.as_str()).collect();
        assert_eq!(commands[0], "pm-photons -q s.obj --glossy -n 5 -t $(THREADS)");
        assert_eq!(commands[1], "pm-queries -q s.obj --glossy --size 8x8 -t $(THREADS) | pm-sample");
        assert!(work.streams.iter().all(|stream| stream.needs == ["s.obj"]));
        let through = made(&[(Stage::Stream, "pm-reorder cells --photons {photons}")]).unwrap();
        let reorder = "< out/streams/default.pmq pm-reorder cells --photons out/streams/default.pmp";
        assert!(through.command.starts_with(&format!("{reorder} | pm-gather -q out/streams/default.pmp -t")));
    }

    #[test]
    fn queries_that_are_kept_and_photons_that_guide() {
        let queries = "--size 8x8 || pm-reorder leaf --photons {photons}";
        let work = made(&[(Stage::Photons, "-n 5"), (Stage::Queries, queries)]).unwrap();
        let [photons, kept, sorted] = &work.streams[..] else { panic!("{work:?}") };
        assert_eq!((kept.file.as_str(), kept.needs.len()), ("out/streams/size-8x8.pmq", 0));
        assert_eq!(sorted.file, "out/streams/size-8x8-pm-reorder-leaf-photons-n-5.pmq");
        assert_eq!(sorted.needs, [kept.file.clone(), photons.file.clone()]);
        assert_eq!(sorted.command, format!("< {} pm-reorder leaf --photons {}", kept.file, photons.file));
        let guided = made(&[(Stage::Photons, "-n 5"), (Stage::Queries, "--guide {photons}")]).unwrap();
        assert_eq!(guided.streams[1].needs, [guided.streams[0].file.clone()]);
        assert!(guided.streams[1].file.ends_with("guide-n-5.pmq"));
    }

    #[test]
    fn points_that_differ_in_caches_alone_share_a_trace() {
        let point = |gather: &str, cache: &str| {
            made(&[(Stage::Photons, "-n 5"), (Stage::Gather, gather), (Stage::Cache, cache)]).unwrap()
        };
        let alone = point("-k 6", "--sizes 4K");
        let mut works = [point("-k 5", "--sizes 4K"), point("-k 5", "--of {photons}"), alone.clone()];
        share_traces(works.iter_mut());
        let trace = "out/streams/n-5.pmp-default.pmq-k-5.pmt";
        for (work, simulates) in works.iter().zip(["--sizes 4K", "--of out/streams/n-5.pmp"]) {
            assert_eq!(work.command, format!("< {trace} pm-cachesim -q --format csv {simulates}"));
            let gathers = work.streams.last().unwrap();
            assert_eq!((gathers.file.as_str(), gathers.needs.len()), (trace, 2));
            assert_eq!(gathers.command, "pm-gather -q out/streams/n-5.pmp out/streams/default.pmq -t $(THREADS) -k 5");
        }
        assert_eq!((works[0].needs.as_slice(), works[1].needs.len()), (&[trace.to_owned()][..], 2));
        assert_eq!(works[2], alone);
    }

    #[test]
    fn a_command_needs_what_it_uses() {
        let work = made(&[(Stage::Command, "cat a > {out}; echo $x #y"), (Stage::Needs, "a b,c")]).unwrap();
        assert_eq!((work.needs.len(), work.streams.len()), (2, 0));
        assert_eq!(for_target(&work.command, "out/t/p"), "cat a > out/t/p; echo $$x \\#y");
        assert_eq!(
            made(&[(Stage::Command, "x {queries}"), (Stage::Queries, "--guide {photons}")]).unwrap().streams.len(),
            2
        );
    }

    #[test]
    fn scenes_with_blanks_and_what_make_would_misread() {
        let work = made(&[(Stage::Scene, "\"my scenes/a.obj\"")]).unwrap();
        assert_eq!(work.streams[0].needs, ["my scenes/a.obj"]);
        assert!(work.streams[0].command.contains("\"my scenes/a.obj\""));
        for scene in ["my scenes/a.obj", "a.obj b.obj", "a:b.obj", "\"a.obj", "a$b.obj", "a%.obj"] {
            assert!(made(&[(Stage::Scene, scene)]).is_err(), "{scene}");
        }
        assert!(made(&[(Stage::Needs, "a:b")]).is_err());
        for (stage, text) in [(Stage::Photons, "a || b"), (Stage::Stream, "a || b"), (Stage::Queries, "a || b || c")] {
            assert!(made(&[(stage, text)]).unwrap_err().contains("||"), "{text}");
        }
    }
}
