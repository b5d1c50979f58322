//! The target that the environment names, led by coverage: `TARGET=mended guided CORPUS`.
#![no_main]

use pm_fuzz::{TARGETS, Target, seeds};
use std::sync::LazyLock;
use std::{env, fs};

/// The target; its inputs are put where the fuzzer keeps what it learns.
static TARGET: LazyLock<&Target> = LazyLock::new(|| {
    let name = env::var("TARGET").expect("TARGET names the target");
    TARGETS.iter().find(|target| target.name == name).expect("a target's name")
});

libfuzzer_sys::fuzz_target!(init: {
    if let Ok(folder) = env::var("SEEDS") {
        for (at, data) in seeds(TARGET.name).iter().enumerate() {
            fs::write(format!("{folder}/seed-{at:03}"), data).expect("the folder of SEEDS can be written to");
        }
    }
}, |data: &[u8]| (TARGET.run)(data));
