//! Orders that do what no order may.

use pm_formats::Query;
use pm_orders::{Costs, Order, Outlet, Reorder, Setting};
use pm_registry::ParameterError;

pm_registry::registered! {
    /// Keeps the last query of all
    pub struct Forgetful = "forgetful";
}

pm_registry::registered! {
    /// Lets a query wait for the next batch
    pub struct Late = "late";
}

pm_registry::registered! {
    /// Says that it holds nothing
    pub struct Modest = "modest";
}

/// Which query a broken order keeps back, and what it tells.
struct Queue {
    held: Vec<Query>,
    costs: Costs,
    /// How many stay at the end of a batch, and whether they come with the next.
    keeps: usize,
    forgets: bool,
    tells: bool,
}

impl Reorder for Queue {
    fn push(&mut self, queries: &[Query], _: &mut Outlet<'_>) -> pm_formats::Result<()> {
        self.held.extend_from_slice(queries);
        if self.tells {
            self.costs.group(self.held.len() as u64, 0, 0);
        }
        Ok(())
    }

    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        let leave = self.held.len().saturating_sub(self.keeps);
        self.held.drain(..leave).try_for_each(|query| out.leave(query))?;
        if self.forgets {
            self.held.clear();
        }
        Ok(())
    }

    fn costs(&self) -> &Costs {
        &self.costs
    }
}

fn queue(setting: &Setting<'_>, keeps: usize, forgets: bool, tells: bool) -> Result<Box<dyn Reorder>, ParameterError> {
    Ok(Box::new(Queue { held: vec![], costs: Costs::new(setting.store), keeps, forgets, tells }))
}

impl Order for Forgetful {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        queue(&setting, 1, true, true)
    }
}

impl Order for Late {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        queue(&setting, 1, false, true)
    }
}

impl Order for Modest {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        queue(&setting, 0, false, false)
    }
}
