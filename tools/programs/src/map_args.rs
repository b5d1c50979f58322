//! Which photon map, as it is typed.

use crate::cli::choice;
use pm_maps::{Layout, MapKind, MapOptions, Orphans, PageForm};

/// Which map to build, and how.
#[derive(clap::Args, Clone, Debug)]
pub struct MapArgs {
    /// Structure of the photon map
    #[arg(long, default_value = "kd", value_parser = choice::<MapKind>())]
    pub map: MapKind,
    /// kd, bucket-kd: where nodes lie in memory; changes the reads, not the answer
    #[arg(long, default_value = "heap", value_parser = choice::<Layout>())]
    pub layout: Layout,
    /// Bytes of a line (leaf, block, page, bucket)
    ///
    /// bucket-kd is fastest with 320: 16 photons.
    #[arg(long, value_name = "BYTES", default_value = "128", value_parser = clap::value_parser!(u32).range(32..=65536))]
    pub line: u32,
    /// kd: pad the records, so that none crosses a line
    #[arg(long, hide_short_help = true)]
    pub pad: bool,
    /// kdb: how full blocks and pages are; 0.6 is what insertion one by one leaves
    #[arg(long, default_value = "1", value_parser = share, hide_short_help = true)]
    pub fill: f64,
    /// kdb: what region pages say of their children
    #[arg(long, default_value = "compact", hide_short_help = true, value_parser = choice::<PageForm>())]
    pub pages: PageForm,
    /// block-hash: number of tables, L [default: ln N, 4 to 16]
    #[arg(long, value_name = "L", value_parser = clap::value_parser!(u32).range(1..=1000), hide_short_help = true)]
    pub tables: Option<u32>,
    /// block-hash: thresholds along each axis, P [default: cells on a wall fill half a bucket, 4 to 64]
    #[arg(long, value_name = "P", value_parser = clap::value_parser!(u32).range(1..=1000), hide_short_help = true)]
    pub thresholds: Option<u32>,
    /// block-hash: references in a bucket; grid-fixed: photons in a cell [default: a line's worth; twice the average]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 20), hide_short_help = true)]
    pub slots: Option<u32>,
    /// block-hash: photons read for each that is wanted, A
    #[arg(long, value_name = "A", default_value = "20", value_parser = clap::value_parser!(u32).range(1..=1 << 20),
        hide_short_help = true)]
    pub budget: u32,
    /// block-hash: what becomes of blocks that no bucket has room for
    #[arg(long, default_value = "keep", hide_short_help = true, value_parser = choice::<Orphans>())]
    pub orphans: Orphans,
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 1.0 => Ok(x),
        _ => Err("a share above 0 and at most 1 is expected".into()),
    }
}

impl MapArgs {
    /// The same, for whoever builds the map.
    #[must_use]
    pub fn options(&self) -> MapOptions {
        let Self { map, layout, line, pad, fill, pages, tables, thresholds, slots, budget, orphans } = self.clone();
        MapOptions { map, layout, line, pad, fill, pages, tables, thresholds, slots, budget, orphans }
    }
}
