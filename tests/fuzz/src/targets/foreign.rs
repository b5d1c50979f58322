//! Others' traces, photons and queries.

use super::streams::Sum;
use pm_exchange::rows::{self, RowOptions};
use pm_exchange::traces::{Opened, Reading, TraceImport, imports, open};
use pm_formats::Step;
use pm_registry::Registry;
use std::io::Cursor;

thread_local! {
    static IMPORTS: Registry<dyn TraceImport> = imports();
}

/// The first byte says in which format; 255 and what is beyond, that the content tells.
pub(super) fn traces(data: &[u8]) {
    let Some((&format, data)) = data.split_first() else { return };
    IMPORTS.with(|imports| {
        let format = imports.iter().nth(usize::from(format));
        let reading = format.map_or_else(Reading::plain, |format| Reading::plain().of(format));
        match open(Cursor::new(data.to_vec()), &reading, imports) {
            Ok(Opened::Foreign(mut trace)) => drop(trace.replay(&mut Sum::default())),
            Ok(Opened::Ours(mut blocks)) => while let Ok(Some(_)) = blocks.next_block() {},
            Err(error) => assert!(!error.to_string().is_empty(), "an error says what"),
        }
    });
}

/// The first byte says as what.
pub(super) fn rows(data: &[u8]) {
    let Some((&how, data)) = data.split_first() else { return };
    let step =
        Step { program: "x".into(), version: "0".into(), arguments: vec![], seed: None, input: None, inputs: vec![] };
    let columns = ["x", "y", "z", "_", "power_r", "power_g", "power_b"].map(str::to_owned).to_vec();
    let options = RowOptions {
        columns: (how & 2 != 0).then_some(columns),
        raw: how & 2 != 0 && how & 4 != 0,
        emitted: u64::from(how) + 1,
        size: (how & 8 != 0).then_some([16, 16]),
    };
    match how & 1 {
        0 => drop(rows::photons(data, &options, step)),
        _ => drop(rows::queries(data, &options, step)),
    }
}
