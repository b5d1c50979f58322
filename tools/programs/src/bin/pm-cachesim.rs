//! Simulates caches over a trace and prints what each would fetch.

use pm_programs::cachesim::{Registries, program, run};
use pm_programs::cli::create_output;
use std::io::Write as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    let registries = Registries::default();
    program(&registries).main(|args, typed| {
        let Some(table) = run(&args, typed, &registries)? else { return Ok(()) };
        let mut output = create_output(args.output())?;
        output.write_all(&table)?;
        output.commit()
    })
}
