//! Names of files that make can read.

use xxhash_rust::xxh3::xxh3_64;

/// The longest name made of options; a longer one ends in a hash of what is cut off. File systems take 255 bytes, and the
/// programs write under a longer name first.
const LONGEST: usize = 200;

/// A file name from options: what is no letter or digit is a dash.
pub(crate) fn slug(text: &str) -> String {
    let mut name = String::new();
    for letter in text.trim_matches(' ').chars() {
        match letter {
            'A'..='Z' | 'a'..='z' | '0'..='9' | '.' | '_' => name.push(letter),
            _ if name.ends_with('-') => {}
            _ => name.push('-'),
        }
    }
    let name = name.trim_matches('-');
    match name.len() {
        0 => "default".into(),
        1..=LONGEST => name.into(),
        _ => format!("{}-{:016x}", &name[..LONGEST - 17], xxh3_64(name.as_bytes())),
    }
}

/// The first letter of a target's name that make would misread.
pub(crate) fn misread_in_target(name: &str) -> Option<char> {
    name.chars().find(|&c| !(c.is_alphanumeric() || "._-+@/".contains(c)))
}

/// The first letter of a prerequisite's name that make would misread; a blank is escaped by [`prerequisite`].
pub(crate) fn misread_in_prerequisite(path: &str) -> Option<char> {
    path.chars().find(|&c| !(c.is_alphanumeric() || "._-+@/, ".contains(c)))
}

/// A file as a prerequisite in a rule.
pub(crate) fn prerequisite(path: &str) -> String {
    path.replace(' ', "\\ ")
}

/// Whether a point's name stays within the folder of its sweep.
pub(crate) fn stays_below(name: &str) -> bool {
    name.split('/').all(|part| !part.is_empty() && !part.starts_with('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_become_names() {
        assert_eq!(slug(" --size 8x8 || pm-sample -q "), "size-8x8-pm-sample-q");
        assert_eq!(slug("my scenes/häuser.obj -n 5"), "my-scenes-h-user.obj-n-5");
        assert_eq!(slug(" - "), "default");
        let (long, other) = (slug(&"a".repeat(300)), slug(&"a".repeat(301)));
        assert!(long.len() == 200 && long.starts_with("aaa") && long != other, "{long}");
        assert_eq!(slug(&"a".repeat(200)), "a".repeat(200));
    }

    #[test]
    fn what_make_would_misread() {
        assert_eq!(misread_in_target("n-5/häuser+a.b"), None);
        for letter in "#$%:=;|'\"*?[~\\() ,{".chars() {
            assert_eq!(misread_in_target(&format!("a{letter}b")), Some(letter));
        }
        assert_eq!(misread_in_prerequisite("my scenes/a,b.obj"), None);
        assert_eq!(prerequisite("my scenes/a.obj"), "my\\ scenes/a.obj");
        assert!(stays_below("100/a") && !stays_below("../a") && !stays_below("/a") && !stays_below("a//b"));
    }
}
