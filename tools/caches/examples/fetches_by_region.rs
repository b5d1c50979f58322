//! Counts the accesses of a trace, region by region, and the lines it touches. `cargo run -p pm-caches --example
//! fetches_by_region FILE.pmt`

use pm_caches::{CacheConfig, Simulation};
use pm_formats::trace::TraceReader;
use std::error::Error;
use std::io::{self, Read, Write};

/// Says how often each region of the trace is fetched from without any cache, which is how often it is read.
pub(crate) fn run(trace: impl Read, out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let mut trace = TraceReader::new(trace)?;
    let regions = trace.header().regions.clone();
    let mut simulation = Simulation::new(&regions, &[CacheConfig::none(64)?])?;
    while trace.replay_block(&mut simulation)?.is_some() {}
    // A trace that stops before its end block is no trace.
    trace.end()?;
    for counts in simulation.finish() {
        for (region, reads) in regions.iter().zip(&counts.region_fetches) {
            writeln!(out, "{:12} {reads:8} reads", region.name)?;
        }
        let (queries, written) = (counts.queries, counts.records.bytes_written);
        writeln!(out, "{queries} queries, {} lines of 64 bytes touched, {written} bytes written", counts.compulsory)?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).ok_or("name a trace: a file that ends in .pmt")?;
    run(std::fs::File::open(path)?, &mut io::stdout().lock())
}
