//! Files written on a thread of their own, so that the computation need not wait for the disk.
//!
//! Jobs are done one after the other in the order in which they were given. A checkpoint that is given behind the
//! snapshots it counts is therefore published only when these are in their files. All calls of HDF5, which lets one
//! thread in at a time, come from this one thread while a run goes on.

use std::{
    panic::resume_unwind,
    sync::mpsc::{Receiver, SyncSender, sync_channel},
    thread::{Builder, JoinHandle},
};

use super::OutputError;

/// Jobs that may wait behind the one that is being done. What they hold is the memory that writing costs.
const WAITING: usize = 1;

type Job<F> = Box<dyn FnOnce(&mut F) -> Result<(), OutputError> + Send>;

/// A thread that writes to the open files `F`, and ends with the first error.
///
/// Dropped before [`Self::drain`], it still does what it was given; an error is then lost, so that only a run that ends
/// with another error should do so.
pub struct Writer<F> {
    jobs: Option<SyncSender<Job<F>>>,
    thread: Option<JoinHandle<Result<(), OutputError>>>,
}

impl<F: Send + 'static> Writer<F> {
    /// A thread that takes over the open files.
    ///
    /// # Panics
    /// If the operating system has no thread to give.
    pub fn spawn(files: F) -> Self {
        let (jobs, waiting) = sync_channel(WAITING);
        let thread = Builder::new().name("writer".to_owned()).spawn(move || work(files, &waiting));
        Self { jobs: Some(jobs), thread: Some(thread.expect("a thread for the writer")) }
    }

    /// Give a job. Waits while another one is waiting already: at most two are in memory besides this one.
    ///
    /// # Errors
    /// If an earlier job has failed: its error. This job is not done then, and the writer must not be used again.
    pub fn give(
        &mut self,
        job: impl FnOnce(&mut F) -> Result<(), OutputError> + Send + 'static,
    ) -> Result<(), OutputError> {
        match self.jobs.as_ref().map(|jobs| jobs.send(Box::new(job))) {
            Some(Ok(())) => Ok(()),
            _ => self.end(),
        }
    }

    /// Whether all has gone well so far; costs next to nothing.
    ///
    /// # Errors
    /// If a job has failed: its error.
    pub fn check(&mut self) -> Result<(), OutputError> {
        if self.thread.as_ref().is_some_and(JoinHandle::is_finished) { self.end() } else { Ok(()) }
    }

    /// Wait until everything given so far is in the files.
    ///
    /// # Errors
    /// If a job has failed: its error.
    pub fn drain(&mut self) -> Result<(), OutputError> {
        let (done, all_done) = sync_channel(1);
        // The receiver is there until `recv` returns.
        self.give(move |_| {
            let _ = done.send(());
            Ok(())
        })?;
        if all_done.recv().is_ok() { Ok(()) } else { self.end() }
    }
}

impl<F> Writer<F> {
    /// Let the thread do what it has, and end it; a panic of the thread goes on in this one.
    fn end(&mut self) -> Result<(), OutputError> {
        self.jobs = None;
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(ended)) => ended,
            Some(Err(panic)) => resume_unwind(panic),
            None => panic!("a writer that has failed was used again"),
        }
    }
}

impl<F> Drop for Writer<F> {
    fn drop(&mut self) {
        self.jobs = None;
        // A second panic while one is under way would end the program without a message.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

fn work<F>(mut files: F, jobs: &Receiver<Job<F>>) -> Result<(), OutputError> {
    jobs.iter().try_for_each(|job| job(&mut files))
}

#[cfg(test)]
mod tests {
    use std::{
        path::Path,
        sync::{Arc, Mutex, mpsc::channel},
        time::Duration,
    };

    use super::*;

    fn error() -> OutputError {
        OutputError::content(Path::new("fluid.vtkhdf"), "no space left")
    }

    /// A job that notes its number.
    fn note(number: u32) -> impl FnOnce(&mut Arc<Mutex<Vec<u32>>>) -> Result<(), OutputError> + Send + 'static {
        move |seen| {
            seen.lock().unwrap().push(number);
            Ok(())
        }
    }

    #[test]
    fn jobs_are_done_in_their_order() {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let mut writer = Writer::spawn(seen.clone());
        (0..20).for_each(|number| writer.give(note(number)).unwrap());
        writer.drain().unwrap();
        assert_eq!(*seen.lock().unwrap(), (0..20).collect::<Vec<_>>());
        writer.give(note(20)).unwrap();
        drop(writer);
        assert_eq!(seen.lock().unwrap().len(), 21);
    }

    #[test]
    fn only_two_jobs_are_in_memory() {
        let (open, gate) = channel::<()>();
        let mut writer = Writer::spawn(gate);
        let wait = |gate: &mut Receiver<()>| {
            gate.recv().unwrap();
            Ok(())
        };
        let given = Arc::new(Mutex::new(0));
        let count = given.clone();
        let giver = std::thread::spawn(move || {
            for _ in 0..4 {
                writer.give(wait).unwrap();
                *count.lock().unwrap() += 1;
            }
            writer.drain().unwrap();
        });
        // One in work and one waiting; the third has to wait however long.
        std::thread::sleep(Duration::from_millis(100));
        assert_eq!(*given.lock().unwrap(), 2);
        (0..4).for_each(|_| open.send(()).unwrap());
        giver.join().unwrap();
        assert_eq!(*given.lock().unwrap(), 4);
    }

    #[test]
    fn the_first_error_is_reported_and_ends_the_work() {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let mut writer = Writer::spawn(seen.clone());
        writer.give(|_| Err(error())).unwrap();
        while writer.thread.as_ref().is_some_and(|thread| !thread.is_finished()) {
            std::thread::yield_now();
        }
        assert_eq!(writer.check().unwrap_err().to_string(), error().to_string());
        let mut writer = Writer::spawn(seen.clone());
        writer.give(|_| Err(error())).unwrap();
        // Given behind the error: not done, whether or not it was still taken.
        let told = writer.give(note(1)).and_then(|()| writer.drain());
        assert_eq!(told.unwrap_err().to_string(), error().to_string());
        assert!(seen.lock().unwrap().is_empty());
    }

    #[test]
    #[should_panic(expected = "one value list a field")]
    fn a_panic_of_the_thread_is_not_lost() {
        let mut writer = Writer::spawn(());
        let _ = writer.give(|()| panic!("one value list a field"));
        let _ = writer.drain();
    }
}
