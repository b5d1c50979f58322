//! The control: without any coherence.

use crate::{Charge, Order, Reorder, Setting};
use pm_formats::Query;
use pm_registry::{Domain, Parameter, ParameterError};

const SEED: Parameter = Parameter::new("seed", Domain::Seed, "seed of its hash").called("SEED").or("0");

pm_registry::registered! {
    /// By a hash of pixel, sample and seed: the control, without any coherence
    pub struct Random = "random" with [SEED];
}

impl Order for Random {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--seed 3"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let seed = setting.values.count(SEED.name);
        let key = move |query: &Query| {
            let mut random = pm_random::Random::new(&[seed, u64::from(query.pixel), u64::from(query.sample)]);
            (random.next_u64() >> 32) as u32
        };
        let keys = move |queries: &[Query]| queries.iter().map(key).collect();
        Ok(setting.sort(Box::new(keys), Charge::MergeSort, 0))
    }
}
