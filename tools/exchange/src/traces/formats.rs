//! A file a format.

mod csv;
mod din;
mod dinb;
mod dramsim3;
mod lackey;
mod lcs;
mod oracle_general;
mod ramulator2;
mod ramulator_cpu;
mod raw32;
mod raw64;
mod xdin;

pub(super) use csv::Csv;
pub(super) use din::Din;
pub(super) use dinb::Dinb;
pub(super) use dramsim3::Dramsim3;
pub(super) use lackey::Lackey;
pub(super) use lcs::Lcs;
pub(super) use oracle_general::OracleGeneral;
pub(super) use ramulator_cpu::RamulatorCpu;
pub(super) use ramulator2::Ramulator2;
pub(super) use raw32::Raw32;
pub(super) use raw64::Raw64;
pub(super) use xdin::Xdin;
