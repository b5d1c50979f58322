//! What becomes of gather rays at mirrors and glass, and do those wait that should?

use super::super::{AtSpecular, GatherOptions, GatherRays, PixelCaster, RayCounts};
use super::pictures::OPTIONS;
use super::scenes::{camera, shipped};
use crate::scene::MaterialKind;
use pm_formats::Query;
use pm_orders::VisiblePoints;

/// The queries of a small picture of the box with its mirror and its glass, those that do not wait and those that do.
fn cast(options: GatherOptions) -> (Vec<Query>, Vec<Query>, RayCounts) {
    let (scene, path) = shipped("cornell.obj");
    let rays = GatherRays::new(&scene, camera(&path), options);
    let (mut queries, mut counts) = (vec![], RayCounts::default());
    let mut caster = PixelCaster::new(&rays, None);
    for y in 0..20 {
        for x in 0..24 {
            caster.pixel([x, y], VisiblePoints::All, |query| queries.push(query), |_| {}, &mut counts);
        }
    }
    let queued = caster.take_queued();
    assert!(caster.take_queued().is_empty());
    (queries, queued, counts)
}

#[test]
fn rays_behind_mirrors_and_glass_wait_and_are_the_same() {
    let options = GatherOptions { gathers: 16, ..OPTIONS };
    let (plain, none, _) = cast(options);
    let (mut direct, queued, _) = cast(GatherOptions { queue_specular: true, ..options });
    assert!(
        none.is_empty() && queued.len() > 100 && direct.len() > 3 * queued.len(),
        "{} {}",
        direct.len(),
        queued.len()
    );
    // Those that stop are those that would wait.
    let (stopped, _, counts) = cast(GatherOptions { at_specular: AtSpecular::Stop, ..options });
    assert_eq!(stopped, direct);
    assert_eq!(counts.gather, counts.gather_lost + stopped.len() as u64);
    direct.extend(queued);
    let sorted = |mut queries: Vec<Query>| {
        queries.sort_by_key(|query| (query.pixel, query.sample));
        queries
    };
    assert_eq!(sorted(plain), sorted(direct));
}

#[test]
fn rays_that_gather_at_mirrors_and_glass_end_there() {
    let options = GatherOptions { gathers: 16, ..OPTIONS };
    let (direct, ..) = cast(GatherOptions { at_specular: AtSpecular::Stop, ..options });
    let (gathered, queued, _) =
        cast(GatherOptions { at_specular: AtSpecular::Gather, queue_specular: true, ..options });
    let (scene, _) = shipped("cornell.obj");
    let is_specular = |query: &Query| {
        matches!(scene.materials[query.material as usize].kind, MaterialKind::Mirror | MaterialKind::Glass)
    };
    // No ray is behind one, and all others are as they were.
    assert!(queued.is_empty());
    let others: Vec<Query> = gathered.iter().filter(|query| !is_specular(query)).copied().collect();
    assert_eq!(others, direct);
    // At least as many end there as come to a surface behind.
    let (_, behind, _) = cast(GatherOptions { queue_specular: true, ..options });
    assert!(gathered.len() - others.len() >= behind.len(), "{} {}", gathered.len() - others.len(), behind.len());
}
