//! Where jobs lie until a thread takes them, and results until it is their turn. A lock and two conditions: jobs are whole blocks
//! of work, so that nobody waits for the lock, and every pair of types that goes through it costs the compiler little.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// Jobs and results of at most so many numbers in a row.
pub(crate) struct Desk<I, O> {
    lying: Mutex<Lying<I, O>>,
    job_came: Condvar,
    result_came: Condvar,
    /// How many jobs are under way at most: numbers that are this far apart share a slot.
    pub(crate) slots: usize,
}

struct Lying<I, O> {
    jobs: VecDeque<(usize, I)>,
    results: Vec<Option<thread::Result<O>>>,
    closed: bool,
}

impl<I, O> Desk<I, O> {
    /// An empty one for so many jobs under way.
    pub(crate) fn new(slots: usize) -> Self {
        let results = (0..slots).map(|_| None).collect();
        let lying = Mutex::new(Lying { jobs: VecDeque::with_capacity(slots), results, closed: false });
        Self { lying, job_came: Condvar::new(), result_came: Condvar::new(), slots }
    }

    /// Gives a job to whoever is free first.
    pub(crate) fn put(&self, number: usize, job: I) {
        self.lock().jobs.push_back((number, job));
        self.job_came.notify_one();
    }

    /// The next job, waited for; `None` once the desk is closed.
    pub(crate) fn job(&self) -> Option<(usize, I)> {
        let mut lying = self.lock();
        while !lying.closed {
            if let Some(job) = lying.jobs.pop_front() {
                return Some(job);
            }
            lying = self.job_came.wait(lying).unwrap_or_else(PoisonError::into_inner);
        }
        None
    }

    /// Lays down what a job came to.
    pub(crate) fn done(&self, number: usize, result: thread::Result<O>) {
        self.lock().results[number % self.slots] = Some(result);
        self.result_came.notify_one();
    }

    /// What the job of this number came to, waited for.
    pub(crate) fn result(&self, number: usize) -> thread::Result<O> {
        let mut lying = self.lock();
        loop {
            if let Some(result) = lying.results[number % self.slots].take() {
                return result;
            }
            lying = self.result_came.wait(lying).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Nothing panics while it holds the lock.
    fn lock(&self) -> MutexGuard<'_, Lying<I, O>> {
        self.lying.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Closes a desk when it is dropped: jobs that nobody took are never begun.
pub(crate) struct Closing<'a, I, O>(pub(crate) &'a Desk<I, O>);

impl<I, O> Drop for Closing<'_, I, O> {
    fn drop(&mut self) {
        self.0.lock().closed = true;
        self.0.job_came.notify_all();
    }
}
