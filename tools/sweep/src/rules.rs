//! Sweeps as rules for make: a target for each stream and each point, and one for the rows of each sweep.
//!
//! What a target runs is the value of a variable named after it, `RUN.TARGET`, so that `scripts/sweep.mk`, which has the recipes
//! (`row`, `stream`) and the function `made_with`, can tell whether it is what the target was made with.

use crate::make::quoted;
use crate::names::prerequisite;
use crate::pipe::share_traces;
use crate::{Stream, Sweep, TableError};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use xxhash_rust::xxh3::xxh3_64;

/// The rules of sweeps. `words` is the file of their vocabularies, by which `pm-sweep join` reads them again.
///
/// # Errors
/// If two streams that are made otherwise would have the same name.
pub fn rules(sweeps: &[Sweep], words: &str) -> Result<String, TableError> {
    let mut text = String::new();
    let mut sweeps = sweeps.to_vec();
    share_traces(sweeps.iter_mut().flat_map(|sweep| &mut sweep.points).map(|point| &mut point.work));
    let streams = streams(&sweeps)?;
    for stream in &streams {
        target(&mut text, &stream.file, &stream.needs, &stream.command);
    }
    list(&mut text, "STREAMS", streams.iter().map(|stream| stream.file.as_str()));
    // Rows outlive them: without them, they are made again only for rows that are missing.
    text += "ifdef STREAMS\n$(STREAMS):\n\t$(call stream,$(RUN.$@))\n.SECONDARY: $(STREAMS)\nendif\n";
    for sweep in &sweeps {
        let Sweep { name, file, points, .. } = sweep;
        let _ = writeln!(text, "\n# {file}");
        let files: Vec<String> = points.iter().map(|point| sweep.rows_of(point)).collect();
        for (point, file) in points.iter().zip(&files) {
            target(&mut text, file, &point.work.needs, &point.work.command);
        }
        list(&mut text, &format!("POINTS.{name}"), files.iter().map(String::as_str));
        let _ = write!(
            text,
            "$(POINTS.{name}):\n\t$(call row,$(RUN.$@))\nLIST.{name} = {:016x}\n{}: $(POINTS.{name}) $(call made_with,LIST.{name} REPORTING)\n\
             \t@pm-sweep join --words {} -o $@ {}\n",
            xxh3_64(listing(sweep).as_bytes()),
            sweep.joined(),
            quoted(words),
            quoted(file),
        );
    }
    Ok(text)
}

/// What the table of all rows has beside them.
fn listing(sweep: &Sweep) -> String {
    let mut listing = sweep.labels.join("\t");
    for point in &sweep.points {
        let _ = write!(listing, "\n{}\t{}", point.name, point.words.join("\t"));
    }
    listing
}

/// The streams of all points, each once and behind those it needs.
fn streams(sweeps: &[Sweep]) -> Result<Vec<&Stream>, TableError> {
    let mut known: BTreeMap<&str, (&Stream, &str, u64)> = BTreeMap::new();
    let mut streams = vec![];
    for sweep in sweeps {
        for point in &sweep.points {
            for stream in &point.work.streams {
                match known.get(stream.file.as_str()) {
                    None => {
                        known.insert(&stream.file, (stream, &sweep.file, point.line));
                        streams.push(stream);
                    }
                    Some((other, _, _)) if *other == stream => {}
                    Some((other, file, line)) => {
                        let what = format!(
                            "`{}` and `{}` ({file}:{line}) would both be {}: write one of them otherwise",
                            stream.command, other.command, stream.file
                        );
                        return Err(TableError { file: sweep.file.clone(), line: point.line, what });
                    }
                }
            }
        }
    }
    Ok(streams)
}

fn target(text: &mut String, file: &str, needs: &[String], command: &str) {
    let needs: String = needs.iter().map(|file| format!(" {}", prerequisite(file))).collect();
    let _ = writeln!(text, "RUN.{file} = {command}\n{file}:{needs} $(call made_with,RUN.{file} PROGRAMS)");
}

fn list<'a>(text: &mut String, name: &str, files: impl Iterator<Item = &'a str>) {
    let files: String = files.map(|file| format!(" \\\n    {file}")).collect();
    let _ = writeln!(text, "{name} :={files}");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Table, Words};

    fn sweep(name: &str, table: &str) -> Result<Sweep, TableError> {
        let file = format!("my tables/{name}.csv");
        Sweep::new(name, &Table::read(&file, table)?, &Words::default(), &|_| None)
    }

    #[test]
    fn a_table_becomes_rules() {
        let one = sweep("a", "k,photons,gather\n10 20,-n 5,-k {k}\n").unwrap();
        let other = sweep("b", "point,photons,scene,command\nx,-n 5,,pm-view {photons}\ny,-n 5,\"\"\"a b.obj\"\"\",\"echo $x \"\"(,\"\" {photons}\"\n").unwrap();
        let text = rules(&[one, other], "words.csv").unwrap();
        let expected = "\
RUN.out/streams/n-5.pmp = pm-photons -q -n 5 -t $(THREADS)
out/streams/n-5.pmp: $(call made_with,RUN.out/streams/n-5.pmp PROGRAMS)
RUN.out/streams/default.pmq = pm-queries -q -t $(THREADS)
out/streams/default.pmq: $(call made_with,RUN.out/streams/default.pmq PROGRAMS)
RUN.out/streams/a-b.obj-n-5.pmp = pm-photons -q \"a b.obj\" -n 5 -t $(THREADS)
out/streams/a-b.obj-n-5.pmp: a\\ b.obj $(call made_with,RUN.out/streams/a-b.obj-n-5.pmp PROGRAMS)
STREAMS := \\
    out/streams/n-5.pmp \\
    out/streams/default.pmq \\
    out/streams/a-b.obj-n-5.pmp
ifdef STREAMS
$(STREAMS):
\t$(call stream,$(RUN.$@))
.SECONDARY: $(STREAMS)
endif

# my tables/a.csv
RUN.out/a/10.csv = pm-gather -q out/streams/n-5.pmp out/streams/default.pmq -t $(THREADS) -k 10 | pm-cachesim -q --format csv
out/a/10.csv: out/streams/n-5.pmp out/streams/default.pmq $(call made_with,RUN.out/a/10.csv PROGRAMS)
RUN.out/a/20.csv = pm-gather -q out/streams/n-5.pmp out/streams/default.pmq -t $(THREADS) -k 20 | pm-cachesim -q --format csv
out/a/20.csv: out/streams/n-5.pmp out/streams/default.pmq $(call made_with,RUN.out/a/20.csv PROGRAMS)
POINTS.a := \\
    out/a/10.csv \\
    out/a/20.csv
$(POINTS.a):
\t$(call row,$(RUN.$@))
LIST.a = 0
out/a.csv: $(POINTS.a) $(call made_with,LIST.a REPORTING)
\t@pm-sweep join --words words.csv -o $@ 'my tables/a.csv'

# my tables/b.csv
RUN.out/b/x.csv = pm-view out/streams/n-5.pmp
out/b/x.csv: out/streams/n-5.pmp $(call made_with,RUN.out/b/x.csv PROGRAMS)
RUN.out/b/y.csv = echo $$x \"(,\" out/streams/a-b.obj-n-5.pmp
out/b/y.csv: out/streams/a-b.obj-n-5.pmp $(call made_with,RUN.out/b/y.csv PROGRAMS)
POINTS.b := \\
    out/b/x.csv \\
    out/b/y.csv
$(POINTS.b):
\t$(call row,$(RUN.$@))
LIST.b = 0
out/b.csv: $(POINTS.b) $(call made_with,LIST.b REPORTING)
\t@pm-sweep join --words words.csv -o $@ 'my tables/b.csv'
";
        let hashless = |line: &str| match line.split_once(" = ") {
            Some((name, _)) if name.starts_with("LIST.") => format!("{name} = 0\n"),
            _ => format!("{line}\n"),
        };
        assert_eq!(text.lines().map(hashless).collect::<String>(), expected);
    }

    #[test]
    fn streams_of_one_name_that_are_not_the_same_are_refused() {
        let one = sweep("a", "point,photons\na,-n 5\n").unwrap();
        let other = sweep("b", "\n\npoint,photons\na,-n  5\n").unwrap();
        let error = rules(&[one.clone(), other], "w").unwrap_err().to_string();
        assert!(error.starts_with("my tables/b.csv:4: ") && error.contains("(my tables/a.csv:2)"), "{error}");
        let again = sweep("c", "point,photons\na,-n 5\n").unwrap();
        assert_eq!(rules(&[one, again], "w").unwrap().matches("RUN.out/streams/n-5.pmp =").count(), 1);
    }
}
