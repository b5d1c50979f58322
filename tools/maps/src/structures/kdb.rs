//! A tree of pages, for memory that is read in lines.

use crate::{AnyMap, BuildError, KdbOptions, KdbTree, PageForm, Setting, Structure};
use pm_registry::{Domain, Parameter, ParameterError, words_of};

const FILL: Parameter =
    Parameter::new("fill", Domain::Share, "how full blocks and pages are; 0.6 is what insertion one by one leaves")
        .called("FILL")
        .or("1")
        .hidden();
const PAGES: Parameter =
    Parameter::new("pages", Domain::Word(words_of::<PageForm>), "what region pages say of their children")
        .called("PAGES")
        .or("compact")
        .hidden();

pm_registry::registered! {
    /// kdB-tree: photon blocks and region pages of one line each
    pub struct Kdb = "kdb" with [FILL, PAGES];
}

impl Structure for Kdb {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--line 32", "--line 320", "--fill 0.4", "--pages boxes", "--pages boxes --line 64 --fill 0.1"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        let (line, pages) = (setting.line(), setting.values.choice::<PageForm>(PAGES.name));
        if pages == PageForm::Boxes && line < pages.least_line() {
            let least = pages.least_line();
            let text = format!(
                "--line {line}: a region page of boxes needs {least} bytes for two of them; use --pages compact"
            );
            return Err(BuildError::Parameter(ParameterError::Unfit(text)));
        }
        let options = KdbOptions { line, pages, fill: setting.values.share(FILL.name) };
        Ok(Box::new(KdbTree::build(setting.photons, options)?))
    }
}
