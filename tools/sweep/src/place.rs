//! A scene in another unit and at another place.

use crate::significant;

/// The text of an OBJ or of its camera file in which every position p became `scale` p + `offset`.
#[must_use]
pub fn placed(text: &str, scale: f64, offset: f64) -> String {
    let coordinate = |word: &str| significant(word.trim().parse().unwrap_or(0.0) * scale + offset, 10);
    let line = |line: &str| {
        if let Some(position) = line.strip_prefix("v ") {
            let words: Vec<String> = position.split_whitespace().take(3).map(coordinate).collect();
            return format!("v {}\n", words.join(" "));
        }
        let place = line.split_once('=').filter(|(key, _)| ["eye", "look_at"].contains(&key.trim_end()));
        let list = place.and_then(|(key, rest)| Some((key, rest.split_once('[')?.1.split_once(']')?.0)));
        match list {
            Some((key, list)) => {
                let words: Vec<String> = list.split(',').map(coordinate).collect();
                format!("{key}= [{}]\n", words.join(", "))
            }
            None => format!("{line}\n"),
        }
    };
    text.lines().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_move_and_nothing_else() {
        let text = "# v 1 2 3\nmtllib a.mtl\nv .5 -1 2\nvn 0 1 0\nf 1 2 3\n";
        assert_eq!(placed(text, 1000.0, 0.5), "# v 1 2 3\nmtllib a.mtl\nv 500.5 -999.5 2000.5\nvn 0 1 0\nf 1 2 3\n");
        let camera = "eye = [0, 0.5, 1.9] # m\nup = [0, 1, 0]\nvfov = 37\n";
        assert_eq!(placed(camera, 100.0, 1e5), "eye = [100000, 100050, 100190]\nup = [0, 1, 0]\nvfov = 37\n");
    }
}
