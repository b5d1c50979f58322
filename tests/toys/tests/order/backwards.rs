//! An order of one's own, all of it: the last query that came leaves first.

use pm_formats::Query;
use pm_orders::{Costs, Order, Outlet, Reorder, Setting};
use pm_registry::{Domain, Parameter, ParameterError};

/// Its one option.
const TWICE: Parameter = Parameter::new("twice", Domain::Flag, "turn them round again");

pm_registry::registered! {
    /// Last in, first out
    pub struct Backwards = "backwards" with [TWICE];
}

impl Order for Backwards {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--twice"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let twice = setting.values.flag(TWICE.name);
        Ok(Box::new(Stack { held: vec![], twice, costs: Costs::new(setting.store) }))
    }
}

/// Queries, and whether each is on chip.
struct Stack {
    held: Vec<(Query, bool)>,
    twice: bool,
    costs: Costs,
}

impl Reorder for Stack {
    fn push(&mut self, queries: &[Query], _: &mut Outlet<'_>) -> pm_formats::Result<()> {
        for &query in queries {
            self.held.push((query, self.costs.admit()));
        }
        Ok(())
    }

    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        if self.twice {
            self.held.reverse();
        }
        while let Some((query, on_chip)) = self.held.pop() {
            self.costs.release(on_chip);
            out.leave(query)?;
        }
        Ok(())
    }

    fn costs(&self) -> &Costs {
        &self.costs
    }
}
