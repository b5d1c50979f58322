//! How much longer a picture takes than the search alone: the same blocks of queries answered with and without it.

use crate::clock::{median, nanoseconds};
use crate::streams::{Photons, Queries};
use pm_film::film::Film;
use pm_film::irradiance::CachedIrradiance;
use pm_gathering::{Answerer, Edges, EstimateOptions, Estimator, Kernel, RadianceEstimate};
use pm_maps::{AnyMap, Search};

/// Nanoseconds a query: the search alone, and with estimate and film; and the ratio of the two within a round.
pub(crate) fn measure(
    map: &dyn AnyMap,
    photons: &Photons,
    queries: &Queries,
    k: usize,
    rounds: usize,
) -> anyhow::Result<[f64; 3]> {
    let Queries { header, blocks, .. } = queries;
    let search = Search::new(k, f32::INFINITY).fit_start(map, &photons.records);
    let options = EstimateOptions {
        k,
        max_dist: f32::INFINITY,
        estimator: Estimator::Unbiased,
        kernel: Kernel::Constant,
        edges: Edges::Cut,
    };
    let estimate = RadianceEstimate::new(&photons.records, &header.materials, photons.emitted_paths, options);
    let estimate = estimate.in_order(map.order());
    let scale = estimate.scale(&header.bounds);
    let unit = Film::new(0, scale);
    let cache = CachedIrradiance::new(vec![], vec![], header.pixels(), true).expect("an empty cache");
    let mut film = Film::new(usize::try_from(header.pixels())?, scale);
    let mut times = [vec![], vec![]];
    for _ in 0..rounds {
        for (picture, times) in times.iter_mut().enumerate() {
            let answerer = Answerer {
                search,
                carry: true,
                group: 1,
                describe: None,
                map,
                header,
                regions: None,
                reread: false,
                cache: &cache,
                precomputed: None,
                estimate: (picture == 1).then_some((&estimate, &unit)),
            };
            let (done, took) = nanoseconds(|| {
                for block in blocks {
                    let answered = answerer.answer(block).map_err(|fault| anyhow::anyhow!("{fault:?}"))?;
                    film.add_all(&answered.contributions)?;
                }
                anyhow::Ok(())
            })?;
            done?;
            times.push(took / queries.len() as f64);
        }
    }
    let [alone, picture] = &mut times;
    let mut ratios: Vec<f64> = picture.iter().zip(&*alone).map(|(picture, alone)| picture / alone).collect();
    Ok([median(alone), median(picture), median(&mut ratios)])
}
