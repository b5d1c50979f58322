//! Photons of one part of a stream: paths dealt out by the thousand, their powers unrounded.

use super::collect::Traced;
use super::{Args, PATHS, check_hope, paths};
use crate::cli::{Progress, Typed};
use pm_formats::vocabulary::{Part, meaning, measure};
use pm_formats::{BlockMeta, Header, Number, StageReport, UnroundedPhoton};
use pm_light::scene::Scene;
use pm_parallel::in_order;
use std::cell::RefCell;

/// Standard deviations by which a part stores more than its share: so seldom do all parts together fall short of the number
/// that is wanted that nobody will see it, and then they are refused.
const MARGIN: f64 = 8.0;

/// What a part has stored so far.
#[derive(Default)]
struct Stored {
    photons: u64,
    /// Paths, and the sum over them of their photons, squared.
    paths: u64,
    squares: u64,
}

impl Stored {
    /// Whether this is a part's share of so many photons, with the others doing no better than chance makes them.
    fn suffices(&self, wanted: u64, part: Part) -> bool {
        if wanted == 0 {
            return true;
        }
        let (photons, paths) = (self.photons as f64, self.paths.max(1) as f64);
        let variance = (self.squares as f64 - photons * photons / paths).max(0.0);
        let more = photons - wanted as f64 / part.of() as f64;
        self.paths > 0 && more >= 0.0 && more * more >= MARGIN * MARGIN * variance
    }

    fn add(&mut self, traced: &Traced) {
        for photons in traced.path_sizes() {
            self.photons += photons;
            self.squares += photons * photons;
        }
        self.paths += PATHS;
    }
}

/// Traces a part of the photons and writes it.
pub(super) fn trace(part: Part, args: &Args, scene: &Scene, mut header: Header, typed: &Typed) -> anyhow::Result<()> {
    header.set_meaning(meaning::PART, part);
    let mut output = args.output.begin(&header)?;
    let progress = Progress::new(Some(args.number / part.of()), "photons", args.common.quiet);
    let paths = paths(args, scene);
    let stored = RefCell::new(Stored::default());
    let mut next = part.number() - 1;
    in_order(
        args.common.threads(),
        || {
            if stored.borrow().suffices(args.number, part) {
                return Ok(None);
            }
            next += part.of();
            Ok(Some(next - part.of()))
        },
        |batch: u64| (batch, Traced::paths(&paths, batch * PATHS..(batch + 1) * PATHS)),
        |(batch, traced)| {
            let mut stored = stored.borrow_mut();
            // Work done ahead is dropped: what is written does not depend on the threads.
            if stored.suffices(args.number, part) {
                return Ok(());
            }
            let photons: Vec<UnroundedPhoton> = traced.unrounded().collect();
            output.write(BlockMeta { batch, ..BlockMeta::default() }, &photons)?;
            stored.add(&traced);
            progress.add(photons.len() as u64);
            check_hope(args, stored.photons, stored.paths)
        },
    )?;
    drop(progress);
    let stored = stored.into_inner();
    let report = StageReport::new(typed.program())
        .with("photons", Number::Count(stored.photons))
        .with(measure::PATHS_TRACED, Number::Count(stored.paths));
    output.finish(vec![report])?.commit()
}
