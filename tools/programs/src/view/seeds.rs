//! Whether two pictures are, as far as they tell, the same but for their seeds: then what they differ by is noise.

use pm_pictures::Description;

/// Numbers of queries of two sets of rays may differ by this share: what is lost is chance.
const CHANCE: f64 = 0.05;

/// What a picture tells of its making.
#[derive(Default)]
struct Made {
    /// Seeds of its photons.
    seeds: Vec<String>,
    /// Number of its queries, and their digest.
    queries: Option<(f64, String)>,
    /// All else, but for the number and digest of the photons.
    rest: Vec<String>,
}

/// Were both made alike, but with other photons and other rays?
pub(super) fn differ_alone(a: &Description, b: &Description) -> bool {
    let [a, b] = [a, b].map(Made::of);
    let (Some((n, digest)), Some((m, other))) = (&a.queries, &b.queries) else { return false };
    let alike = a.rest == b.rest && (n - m).abs() <= CHANCE * n.max(*m);
    alike && digest != other && a.seeds.iter().zip(&b.seeds).all(|(seed, other)| seed != other)
}

impl Made {
    fn of(picture: &Description) -> Self {
        let mut made = Self::default();
        let comments = picture.attributes.iter().filter(|(name, _)| name == "comments");
        let lines = comments.flat_map(|(_, value)| value.lines()).filter_map(|line| line.strip_prefix("photonmap."));
        for (name, value) in lines.filter_map(|line| line.split_once(" = ")) {
            match name {
                "photons" => {}
                "queries" => {
                    let parts = value.split_once(", digest ");
                    let known = parts.and_then(|(n, digest)| Some((n.parse().ok()?, digest.to_owned())));
                    made.queries = known;
                }
                "history" => {
                    let (rest, seed) = without_seed(value);
                    made.rest.push(rest);
                    made.seeds.push(seed);
                }
                _ => made.rest.push(format!("{name} = {value}")),
            }
        }
        made
    }
}

/// A command without its seed, and the seed: 0 unless it is said.
fn without_seed(command: &str) -> (String, String) {
    let mut seed = "0".to_owned();
    let mut kept = vec![];
    let mut words = command.split_whitespace();
    while let Some(word) = words.next() {
        match word.strip_prefix("--seed") {
            Some("") => words.next().unwrap_or_default().clone_into(&mut seed),
            Some(value) if value.starts_with('=') => value[1..].clone_into(&mut seed),
            _ => kept.push(word),
        }
    }
    (kept.join(" "), seed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(photons: &str, queries: &str) -> Description {
        let line = |name: &str, value: &str| format!("photonmap.{name} = {value}\n");
        let lines = [line("k", "50"), line("queries", queries), line("history", photons)].concat();
        Description { size: [1, 1], channels: vec![], attributes: vec![("comments".to_owned(), lines)] }
    }

    #[test]
    fn seeds_are_told_from_what_is_made() {
        let first = picture("pm-photons -n 50 --seed 1", "1000, digest a");
        assert!(differ_alone(&first, &picture("pm-photons -n 50 --seed=2", "1001, digest b")));
        // What is not said is 0.
        assert!(differ_alone(&first, &picture("pm-photons -n 50", "1000, digest b")));
        for (photons, queries) in [
            ("pm-photons -n 50 --seed 1", "1000, digest b"),
            ("pm-photons -n 50 --seed 2", "1000, digest a"),
            ("pm-photons -n 60 --seed 2", "1000, digest b"),
            ("pm-photons -n 50 --seed 2", "4000, digest b"),
        ] {
            assert!(!differ_alone(&first, &picture(photons, queries)), "{photons}, {queries}");
        }
        let unknown = Description { attributes: vec![], ..first.clone() };
        assert!(!differ_alone(&unknown, &unknown) && !differ_alone(&first, &unknown));
    }
}
