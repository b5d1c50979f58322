//! Work on many threads with results in order: what is done never depends on how many there are.

mod desk;

use desk::{Closing, Desk};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::thread::Builder;

/// Takes jobs from `next` until it says `None`, does `work` on them on `threads` threads, and hands the results to `take`
/// in the order of the jobs. `next` and `take` run on the calling thread. At most a few jobs per thread are held. Where the
/// system refuses threads, those that it gave do the work, or the calling one.
///
/// # Errors
/// The first error of `next` or `take`; jobs begun by then are finished and dropped.
pub fn in_order<I: Send, O: Send, E>(
    threads: usize,
    mut next: impl FnMut() -> Result<Option<I>, E>,
    work: impl Fn(I) -> O + Sync,
    mut take: impl FnMut(O) -> Result<(), E>,
) -> Result<(), E> {
    if threads <= 1 {
        return alone(&mut next, &work, &mut take);
    }
    let desk = Desk::new(3 * threads);
    std::thread::scope(|scope| {
        // Closed on every way out, so that the threads end.
        let _closing = Closing(&desk);
        let mut given = 0;
        // Those that were given and left no memory for their work would be the end of all.
        let most = (0..=threads).rev().find(|&given| is_room(given * A_THREADS_ROOM)).unwrap_or(0);
        for _ in 0..most {
            let spawned = Builder::new().spawn_scoped(scope, || {
                while let Some((number, job)) = desk.job() {
                    // A panic must reach the caller, who would otherwise wait for this result for ever.
                    desk.done(number, catch_unwind(AssertUnwindSafe(|| work(job))));
                }
            });
            if spawned.is_err() {
                break;
            }
            given += 1;
        }
        if given == 0 {
            return alone(&mut next, &work, &mut take);
        }
        let (mut sent, mut taken, mut more) = (0, 0, true);
        loop {
            while more && sent - taken < desk.slots {
                match next()? {
                    Some(job) => {
                        desk.put(sent, job);
                        sent += 1;
                    }
                    None => more = false,
                }
            }
            if taken == sent {
                return Ok(());
            }
            let result = desk.result(taken).unwrap_or_else(|panic| resume_unwind(panic));
            taken += 1;
            take(result)?;
        }
    })
}

/// Memory that a thread has to find, in bytes of addresses: its stack, the 64 MiB that the C library sets apart for what it
/// allocates, and a block's work beyond.
const A_THREADS_ROOM: usize = 80 << 20;

/// Would the system give so many bytes? They are given back at once: whoever asks takes them next.
#[must_use]
pub fn is_room(bytes: usize) -> bool {
    let mut room: Vec<u8> = vec![];
    std::hint::black_box(room.try_reserve_exact(bytes)).is_ok()
}

/// The same on the calling thread.
fn alone<I, O, E>(
    next: &mut impl FnMut() -> Result<Option<I>, E>,
    work: &impl Fn(I) -> O,
    take: &mut impl FnMut(O) -> Result<(), E>,
) -> Result<(), E> {
    while let Some(job) = next()? {
        take(work(job))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_the_order_of_the_jobs() {
        for threads in [1, 2, 5] {
            let mut jobs = 0..200u64;
            let mut got = vec![];
            let slow_when_even = |n: u64| {
                if n.is_multiple_of(2) {
                    std::thread::yield_now();
                }
                n * n
            };
            in_order(
                threads,
                || Ok::<_, ()>(jobs.next()),
                slow_when_even,
                |n| {
                    got.push(n);
                    Ok(())
                },
            )
            .unwrap();
            assert_eq!(got, (0..200).map(|n| n * n).collect::<Vec<_>>());
        }
    }

    #[test]
    fn an_error_ends_it() {
        for threads in [1, 3] {
            let mut jobs = 0..;
            let outcome = in_order(threads, || Ok(jobs.next()), |n: u32| n, |n| if n < 10 { Ok(()) } else { Err(n) });
            assert_eq!(outcome, Err(10));
            let mut jobs = 0..;
            let next = || jobs.next().filter(|&n| n < 10).map(Some).ok_or("no more");
            assert_eq!(in_order(threads, next, |n: u32| n, |_| Ok(())), Err("no more"));
        }
    }

    #[test]
    #[should_panic(expected = "seven")]
    fn a_panic_reaches_the_caller() {
        let mut jobs = 0..100;
        let work = |n: u32| assert!(n != 7, "seven");
        let _ = in_order(2, || Ok::<_, ()>(jobs.next()), work, |()| Ok(()));
    }
}
