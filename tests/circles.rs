//! Do modules know one another in circles?
//!
//! A module that stands beside another may know it, if that one does not know the first, be it by way of others. What a
//! parent passes on by `pub use` counts as the child's that it is from.

use crate::tidy::{code, crates, sources};
use std::collections::{BTreeMap, BTreeSet};

/// Path of a module within its crate.
type Module = Vec<String>;

/// The modules of a crate with the paths that each mentions, tests left out.
struct Crate {
    mentions: BTreeMap<Module, BTreeSet<Vec<String>>>,
    /// By module and name, what a `pub use` of the module stands for.
    passed_on: BTreeMap<(Module, String), Vec<String>>,
}

impl Crate {
    fn new(files: &[(String, String)]) -> Self {
        let mut found = Self { mentions: BTreeMap::new(), passed_on: BTreeMap::new() };
        for (path, text) in files {
            let module: Module = path.trim_end_matches(".rs").split('/').map(String::from).collect();
            if module.iter().any(|name| name == "tests" || name.ends_with("_tests")) {
                continue;
            }
            let module = if module == ["lib"] { vec![] } else { module };
            let code = code(text);
            let code = code.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            let mut mentions = BTreeSet::new();
            for statement in code.split_inclusive([';', '{', '}']).collect::<String>().split(';') {
                let passes_on = statement.trim_start().starts_with("pub use ");
                let paths = paths(statement);
                for path in paths {
                    let Some(name) = path.last().filter(|_| passes_on) else {
                        mentions.insert(path);
                        continue;
                    };
                    found.passed_on.insert((module.clone(), name.clone()), path);
                }
            }
            found.mentions.insert(module, mentions);
        }
        found
    }
}

/// All paths in some code that begin at the crate, at the module itself or at one above, braces taken apart; and, in a `use`,
/// those that begin at a child.
fn paths(code: &str) -> Vec<Vec<String>> {
    let mut found = vec![];
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut rest = code;
    while let Some(at) = rest.find("::") {
        // The word before the two colons.
        let begin = rest[..at].rfind(|c| !is_name(c)).map_or(0, |i| i + 1);
        let path = &rest[begin..];
        let end = branches(path, &[], &mut found);
        rest = &path[end..];
    }
    found
}

/// Reads one path, or several in braces, and gives where it ends.
fn branches(text: &str, before: &[String], found: &mut Vec<Vec<String>>) -> usize {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut path = before.to_vec();
    let mut at = 0;
    loop {
        at += text[at..].len() - text[at..].trim_start().len();
        let name = text[at..].find(|c| !is_name(c)).unwrap_or(text.len() - at);
        if name > 0 {
            path.push(text[at..at + name].to_owned());
            at += name;
            if let Some(rest) = text[at..].strip_prefix("::") {
                at = text.len() - rest.len();
                continue;
            }
        } else if text[at..].starts_with('{') {
            at += 1;
            while !text[at..].trim_start().starts_with('}') && at < text.len() {
                at += branches(&text[at..], &path, found);
                at += text[at..].find([',', '}']).map_or(text.len() - at, |i| i);
                at += usize::from(text[at..].starts_with(','));
            }
            return text.len().min(at + text[at..].find('}').map_or(0, |i| i + 1));
        }
        found.push(path);
        return at.max(1);
    }
}

impl Crate {
    /// The module that a path mentioned in another stands for, if it is one of this crate.
    fn resolve(&self, from: &Module, path: &[String]) -> Option<Module> {
        let (mut at, mut rest): (Module, &[String]) = match path.first()?.as_str() {
            "crate" => (vec![], &path[1..]),
            "self" => (from.clone(), &path[1..]),
            "super" => (from.split_last()?.1.to_vec(), &path[1..]),
            _ => (from.clone(), path),
        };
        let mut steps = 0;
        while let Some((name, further)) = rest.split_first() {
            steps += 1;
            if name == "super" {
                at.pop()?;
            } else if self.mentions.contains_key(&[&at[..], std::slice::from_ref(name)].concat()) {
                at.push(name.clone());
            } else if let Some(target) = self.passed_on.get(&(at.clone(), name.clone())).filter(|_| steps < 20) {
                return self.resolve(&at, target);
            } else if steps == 1 && !["crate", "self", "super"].contains(&path[0].as_str()) {
                return None;
            } else {
                break;
            }
            rest = further;
        }
        Some(at)
    }

    /// Which children of each module know which of their siblings; a module's own code is a child without a name.
    fn acquaintances(&self) -> BTreeMap<Module, BTreeSet<(String, String)>> {
        let mut all: BTreeMap<Module, BTreeSet<(String, String)>> = BTreeMap::new();
        for (module, mentions) in &self.mentions {
            for target in mentions.iter().filter_map(|path| self.resolve(module, path)) {
                let common = module.iter().zip(&target).take_while(|(a, b)| a == b).count();
                let child = |of: &Module| of.get(common).cloned().unwrap_or_default();
                let (knows, known) = (child(module), child(&target));
                if knows != known {
                    all.entry(module[..common].to_vec()).or_default().insert((knows, known));
                }
            }
        }
        all
    }
}

/// A circle among these, if there is one.
fn circle(acquaintances: &BTreeSet<(String, String)>) -> Option<Vec<&str>> {
    let mut left: BTreeSet<(&str, &str)> = acquaintances.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    // Who knows nobody who is left is in no circle.
    loop {
        let knowing: BTreeSet<&str> = left.iter().map(|(knows, _)| *knows).collect();
        let before = left.len();
        left.retain(|(_, known)| knowing.contains(known));
        if left.len() == before {
            return (!left.is_empty()).then(|| knowing.into_iter().collect());
        }
    }
}

/// Circles in a crate, each the parent and its children: circles that the parent closes, and those of children alone.
fn circles(files: &[(String, String)]) -> [Vec<String>; 2] {
    let mut acquaintances = Crate::new(files).acquaintances();
    let described = |acquaintances: &BTreeMap<Module, BTreeSet<(String, String)>>| {
        let described = acquaintances.iter().filter_map(|(parent, known)| {
            let parent = if parent.is_empty() { "crate".to_owned() } else { parent.join("::") };
            circle(known).map(|circle| format!("{parent}: {}", circle.join(" ")))
        });
        described.collect::<Vec<_>>()
    };
    let all = described(&acquaintances);
    acquaintances.values_mut().for_each(|known| known.retain(|(a, b)| !a.is_empty() && !b.is_empty()));
    let of_children = described(&acquaintances);
    [all.into_iter().filter(|circle| !of_children.contains(circle)).collect(), of_children]
}

/// Crates in which a child may know what its parent defines while the parent uses the child.
const WITH_PARENTS: &[&str] =
    &["tools/caches", "tools/gathering", "tools/maps", "tools/programs", "tools/report", "tools/verdicts"];

/// Crates whose modules still know one another in circles: a map asks its observer, and an observer its map; the simulation,
/// its models and what it finds.
const WITH_CIRCLES: &[&str] = &["tools/caches", "tools/maps"];

#[test]
fn modules_know_one_another_one_way() {
    let all = crates().into_iter().map(|name| format!("tools/{name}")).chain(["formats".to_owned()]);
    let (mut with_parents, mut with_circles) = (BTreeMap::new(), BTreeMap::new());
    for name in all {
        let of_crate = |(path, text): (String, String)| Some((path.split_once("/src/")?.1.to_owned(), text));
        let files: Vec<_> = sources(&name).into_iter().filter_map(of_crate).collect();
        let [by_parents, of_children] = circles(&files);
        with_parents.insert(name.clone(), by_parents);
        with_circles.insert(name, of_children);
    }
    for (found, listed) in [(with_parents, WITH_PARENTS), (with_circles, WITH_CIRCLES)] {
        let names: Vec<&str> =
            found.iter().filter(|(_, circles)| !circles.is_empty()).map(|(name, _)| &**name).collect();
        assert_eq!(names, listed, "{found:#?}");
    }
}

#[test]
fn a_circle_is_found_however_it_is_closed() {
    let found = |files: &[(&str, &str)]| {
        let files: Vec<_> = files.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect();
        circles(&files).concat()
    };
    let a = ("a.rs", "use super::b::{self, c::{D, E}};\nuse std::fmt;\n");
    let circle = ["crate: a b"];
    assert_eq!(found(&[("lib.rs", "mod a;\nmod b;"), a, ("b.rs", "use super::a::A;")]), circle);
    assert_eq!(found(&[("lib.rs", "mod a;\nmod b;"), a, ("b.rs", "fn f() { crate::a::g() }")]), circle);
    assert_eq!(found(&[("lib.rs", "mod a;\nmod b;\npub use a::{A, B};"), a, ("b.rs", "use crate::B;")]), circle);
    assert_eq!(found(&[("lib.rs", "mod a;\nmod b;"), a, ("b.rs", ""), ("b/c.rs", "use super::super::a;")]), circle);
    // Neither a comment nor a test closes one, nor another crate's module of the same name.
    let b = "// use super::a;\nuse other::a::A;\n#[cfg(test)]\nmod tests {\n    use super::super::a::A;\n}\n";
    assert!(found(&[("lib.rs", "mod a;\nmod b;"), a, ("b.rs", b), ("b/tests.rs", "use crate::a;")]).is_empty());
    // A child that uses what its parent has defined, where the parent uses the child.
    let parent = ("a.rs", "mod b;\nuse b::B;\nstruct A(B);");
    assert_eq!(found(&[("lib.rs", "mod a;"), parent, ("a/b.rs", "struct B;\nuse super::A;")]), ["a:  b"]);
    assert!(found(&[("lib.rs", "mod a;"), parent, ("a/b.rs", "struct B;")]).is_empty());
}
