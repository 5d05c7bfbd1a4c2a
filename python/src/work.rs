//! Work without the interpreter's lock, which tells how far it has come and ends at Ctrl-C.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// Time between two looks at signals.
const PATIENCE: Duration = Duration::from_millis(20);

/// Told by the work: share of it that is done, 0 to 1, and what it is at; `false` ends it.
pub type Tell<'a> = dyn Fn(f64, String) -> bool + Sync + 'a;

/// Runs `work` in a thread of its own, with so many for its parts (0: a core each); Python runs on meanwhile.
/// `progress(share, text)` is called now and then, and at the end with what was told last.
///
/// # Errors
/// The exceptions of `progress`, and KeyboardInterrupt: both end the work.
pub fn run<T: Send>(
    py: Python<'_>,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Tell<'_>) -> T + Send,
) -> PyResult<T> {
    let (result, raised) = run_to_end(py, threads, progress, work)?;
    raised.map_or(Ok(result), Err)
}

/// The same, with the exception that ended the work beside what it came to.
///
/// # Errors
/// Work that panicked.
pub fn run_to_end<T: Send>(
    py: Python<'_>,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Tell<'_>) -> T + Send,
) -> PyResult<(T, Option<PyErr>)> {
    let progress = progress.map(|callable| callable.clone().unbind());
    let (ended, news) = (AtomicBool::new(false), Mutex::new(None::<(f64, String)>));
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool =
        pool.map_err(|e| PyRuntimeError::new_err(format!("{threads} threads cannot be started: {e}")))?;
    py.detach(|| {
        thread::scope(|scope| {
            let (done, wait) = sync_channel::<()>(1);
            let (ended, news) = (&ended, &news);
            let handle = scope.spawn(move || {
                // dropped at the end, also of a panic, which wakes the one who waits
                let _done = done;
                let tell = |share: f64, text: String| {
                    *news.lock().unwrap_or_else(PoisonError::into_inner) = Some((share, text));
                    !ended.load(Ordering::Relaxed)
                };
                pool.install(|| work(&tell))
            });
            let mut raised = None;
            let mut look = || {
                let seen = Python::attach(|py| {
                    py.check_signals()?;
                    let told = news.lock().unwrap_or_else(PoisonError::into_inner).take();
                    match (&progress, told) {
                        (Some(callable), Some(told)) => callable.call1(py, told).map(|_| ()),
                        _ => Ok(()),
                    }
                });
                if let Err(error) = seen {
                    ended.store(true, Ordering::Relaxed);
                    raised.get_or_insert(error);
                }
            };
            while wait.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                look();
            }
            // what was told last
            look();
            let result = handle
                .join()
                .map_err(|_| PyRuntimeError::new_err("the computation panicked: please report it"));
            Ok((result?, raised))
        })
    })
}
