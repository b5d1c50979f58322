//! Samples that hang together: a piece of one surface without walls across it.

use super::Sample;
use pm_maps::geometry::distance_squared;

/// The most samples of which each is reached from the others, by way of them: one that lies within the reach of another is on the
/// same side of every edge that the other's photons showed. Of equals those with the first sample.
pub(super) fn largest<'a>(samples: &[&'a Sample]) -> Vec<&'a Sample> {
    let mut waiting: Vec<&Sample> = samples.to_vec();
    let mut best: Vec<&Sample> = vec![];
    while waiting.len() > best.len() {
        let mut together = vec![waiting.remove(0)];
        let mut next = 0;
        while next < together.len() {
            let from = together[next];
            let near = |other: &&Sample| {
                let reach = from.reach.max(other.reach);
                distance_squared(from.position, other.position) <= reach * reach
            };
            let (reached, others): (Vec<_>, Vec<_>) = waiting.into_iter().partition(near);
            together.extend(reached);
            waiting = others;
            next += 1;
        }
        if together.len() > best.len() {
            best = together;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(places: &[(f32, f32)]) -> Vec<Sample> {
        let sample =
            |&(x, reach)| Sample { position: [x, 0.0, 0.0], normal: [0.0, 1.0, 0.0], irradiance: [1.0; 3], reach };
        places.iter().map(sample).collect()
    }

    #[test]
    fn the_largest_patch_is_found_by_hand() {
        let largest = |places: &[(f32, f32)]| -> Vec<f32> {
            let row = row(places);
            let mut found: Vec<f32> =
                largest(&row.iter().collect::<Vec<_>>()).iter().map(|it| it.position[0]).collect();
            found.sort_by(f32::total_cmp);
            found
        };
        assert!(largest(&[]).is_empty());
        assert_eq!(largest(&[(0.0, 0.1), (1.0, 0.1)]), [0.0]);
        // A chain, each reached by the one before or the one behind; and two that are reached by none of them.
        assert_eq!(largest(&[(9.0, 1.0), (0.0, 1.0), (2.0, 1.0), (1.0, 0.0), (9.5, 0.0)]), [0.0, 1.0, 2.0]);
        assert_eq!(largest(&[(5.0, 0.0), (0.0, 6.0)]), [0.0, 5.0]);
    }
}
