//! Simulates caches over a made-up trace: a matrix read by rows, and by columns. `cargo run -p pm-caches --example made_up_trace`

use pm_caches::{CacheConfig, Simulation};
use pm_formats::trace::{Access, Coding, TraceSink as _, lay_out};
use std::error::Error;
use std::io::{self, Write};

/// Rows and columns of numbers of four bytes.
const SIDE: u64 = 256;

/// Says what each cache fetches of the matrix.
pub(crate) fn run(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let regions = lay_out([("matrix".to_owned(), SIDE * SIDE * 4, 4, Coding::Records)]);
    let caches = ["8K,full,64,lru", "16K,full,64,lru", "16K,8,64,plru", "16K,8,64,plru,hash", "none"];
    let caches = caches.iter().map(|text| text.parse()).collect::<Result<Vec<CacheConfig>, _>>()?;
    let at = |row: u64, column: u64| Access::read(0, (row * SIDE + column) * 4, 4);
    let by_rows = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| at(row, column)));
    let by_columns = (0..SIDE).flat_map(|column| (0..SIDE).map(move |row| at(row, column)));
    for (name, accesses) in [("rows", by_rows.collect::<Vec<_>>()), ("columns", by_columns.collect())] {
        let mut simulation = Simulation::new(&regions, &caches)?;
        simulation.search(&[0]); // one question is answered by all of it
        accesses.into_iter().for_each(|access| simulation.access(access));
        for counts in simulation.finish() {
            let (cache, fetches) = (counts.config.to_string(), counts.fetches);
            writeln!(out, "by {name:7} {cache:18} {fetches:5} fetches, {:7} bytes", counts.traffic_bytes())?;
        }
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout().lock())
}
