//! Writing of files on a separate thread, so that the computation does not wait for the disk.
//!
//! Jobs run in the order in which they are submitted. Snapshots are submitted before the checkpoint that counts them.
//! Therefore they are in their files when this checkpoint replaces the previous checkpoint. During a run, only this
//! thread calls HDF5, because HDF5 serves one thread at a time.

use std::{
    panic::resume_unwind,
    sync::mpsc::{Receiver, SyncSender, sync_channel},
    thread::{Builder, JoinHandle},
};

use super::OutputError;

/// Number of jobs that may wait while one job runs. The limit saves memory, because each job owns a copy of its data.
const WAITING: usize = 1;

type Job<F> = Box<dyn FnOnce(&mut F) -> Result<(), OutputError> + Send>;

/// A thread that writes to the open files `F` and ends at the first error.
///
/// A writer that is dropped without a call of [`Self::drain`] still finishes its jobs, but their errors are lost. This
/// is acceptable only if the run already ends with another error.
pub struct Writer<F> {
    jobs: Option<SyncSender<Job<F>>>,
    thread: Option<JoinHandle<Result<(), OutputError>>>,
}

impl<F: Send + 'static> Writer<F> {
    /// Starts the writer thread, which takes ownership of the open files.
    ///
    /// # Panics
    /// If the operating system cannot start a thread.
    pub fn spawn(files: F) -> Self {
        let (jobs, waiting) = sync_channel(WAITING);
        let thread = Builder::new().name("writer".to_owned()).spawn(move || run_jobs(files, &waiting));
        Self { jobs: Some(jobs), thread: Some(thread.expect("the operating system starts a thread for the writer")) }
    }

    /// Submits a job. Blocks while another job waits, so that at most two other jobs are in memory.
    ///
    /// # Errors
    /// The error of an earlier job that failed. The submitted job is then not run, and the writer must not be used
    /// again.
    pub fn give(
        &mut self,
        job: impl FnOnce(&mut F) -> Result<(), OutputError> + Send + 'static,
    ) -> Result<(), OutputError> {
        match self.jobs.as_ref().map(|jobs| jobs.send(Box::new(job))) {
            Some(Ok(())) => Ok(()),
            _ => self.end(),
        }
    }

    /// Checks without waiting whether a job has failed.
    ///
    /// # Errors
    /// The error of the job that failed.
    pub fn check(&mut self) -> Result<(), OutputError> {
        if self.thread.as_ref().is_some_and(JoinHandle::is_finished) { self.end() } else { Ok(()) }
    }

    /// Waits until all submitted jobs are finished.
    ///
    /// # Errors
    /// The error of the job that failed.
    pub fn drain(&mut self) -> Result<(), OutputError> {
        let (done, all_done) = sync_channel(1);
        // `send` cannot fail, because the receiver exists until `recv` returns.
        self.give(move |_| {
            let _ = done.send(());
            Ok(())
        })?;
        if all_done.recv().is_ok() { Ok(()) } else { self.end() }
    }
}

impl<F> Writer<F> {
    /// Ends the writer thread after its remaining jobs. Resumes a panic of the writer thread in the calling thread.
    fn end(&mut self) -> Result<(), OutputError> {
        self.jobs = None;
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(ended)) => ended,
            Some(Err(panic)) => resume_unwind(panic),
            None => panic!("the writer was used again after an error"),
        }
    }
}

impl<F> Drop for Writer<F> {
    fn drop(&mut self) {
        self.jobs = None;
        // A panic of the thread is ignored: a second panic during a panic would end the program without a message.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

fn run_jobs<F>(mut files: F, jobs: &Receiver<Job<F>>) -> Result<(), OutputError> {
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

    /// Returns a job that records its number.
    fn record(number: u32) -> impl FnOnce(&mut Arc<Mutex<Vec<u32>>>) -> Result<(), OutputError> + Send + 'static {
        move |seen| {
            seen.lock().unwrap().push(number);
            Ok(())
        }
    }

    #[test]
    fn jobs_run_in_order() {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let mut writer = Writer::spawn(seen.clone());
        (0..20).for_each(|number| writer.give(record(number)).unwrap());
        writer.drain().unwrap();
        assert_eq!(*seen.lock().unwrap(), (0..20).collect::<Vec<_>>());
        writer.give(record(20)).unwrap();
        drop(writer);
        assert_eq!(seen.lock().unwrap().len(), 21);
    }

    #[test]
    fn only_two_submitted_jobs_are_in_memory() {
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
        // One job runs and one job waits; the third call of `give` blocks.
        std::thread::sleep(Duration::from_millis(100));
        assert_eq!(*given.lock().unwrap(), 2);
        (0..4).for_each(|_| open.send(()).unwrap());
        giver.join().unwrap();
        assert_eq!(*given.lock().unwrap(), 4);
    }

    #[test]
    fn the_first_error_is_reported_and_stops_later_jobs() {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let mut writer = Writer::spawn(seen.clone());
        writer.give(|_| Err(error())).unwrap();
        while writer.thread.as_ref().is_some_and(|thread| !thread.is_finished()) {
            std::thread::yield_now();
        }
        assert_eq!(writer.check().unwrap_err().to_string(), error().to_string());
        let mut writer = Writer::spawn(seen.clone());
        writer.give(|_| Err(error())).unwrap();
        // A job submitted after the error is not run, even if `give` still accepts the job.
        let result = writer.give(record(1)).and_then(|()| writer.drain());
        assert_eq!(result.unwrap_err().to_string(), error().to_string());
        assert!(seen.lock().unwrap().is_empty());
    }

    #[test]
    #[should_panic(expected = "one list of values per field")]
    fn a_panic_of_the_thread_is_resumed() {
        let mut writer = Writer::spawn(());
        let _ = writer.give(|()| panic!("one list of values per field"));
        let _ = writer.drain();
    }
}
