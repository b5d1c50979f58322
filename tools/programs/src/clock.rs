//! Processor time: that of this process, and that of the programs it has run.

use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeValLike as _;

/// Seconds of processor time that this process has taken.
pub(crate) fn own_seconds() -> f64 {
    seconds(UsageWho::RUSAGE_SELF)
}

/// Seconds of processor time that programs have taken that this process has run and waited for, with those that they ran.
pub(crate) fn seconds_of_others() -> f64 {
    seconds(UsageWho::RUSAGE_CHILDREN)
}

fn seconds(of: UsageWho) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "microseconds of a year are below 2^53")]
    let seconds = |time: nix::sys::time::TimeVal| time.num_microseconds() as f64 / 1e6;
    getrusage(of).map_or(0.0, |usage| seconds(usage.user_time()) + seconds(usage.system_time()))
}
