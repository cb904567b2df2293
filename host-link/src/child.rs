//! Child processes. A child process ends when its owner drops it or when the program is interrupted.

use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Child processes that are running. A thread holds the lock while it starts or drops a child, so that an interruption
/// finds each child either in the list or ended.
static CHILDREN: Mutex<Vec<Arc<Mutex<Child>>>> = Mutex::new(Vec::new());

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A child process that is ended when dropped.
#[derive(Debug)]
pub(crate) struct ChildProcess(Arc<Mutex<Child>>);

impl ChildProcess {
    /// Starts `command`.
    pub(crate) fn start(command: &mut Command) -> io::Result<Self> {
        let mut children = lock(&CHILDREN);
        let child = Arc::new(Mutex::new(command.spawn()?));
        children.push(child.clone());
        Ok(Self(child))
    }

    /// Returns the exit status if the process has ended.
    pub(crate) fn ended(&self) -> Option<ExitStatus> {
        lock(&self.0).try_wait().ok().flatten()
    }

    /// Returns up to `max_bytes` bytes from the piped standard error of a process that has ended.
    pub(crate) fn errors(&self, max_bytes: u64) -> String {
        let mut text = String::new();
        if let Some(errors) = lock(&self.0).stderr.as_mut() {
            let _ = errors.take(max_bytes).read_to_string(&mut text);
        }
        text
    }
}

impl Drop for ChildProcess {
    fn drop(&mut self) {
        let mut children = lock(&CHILDREN);
        children.retain(|child| !Arc::ptr_eq(child, &self.0));
        end(&self.0);
    }
}

/// Ends a child unless it has already ended.
fn end(child: &Mutex<Child>) {
    let mut child = lock(child);
    let _ = child.kill();
    let _ = child.wait();
}

/// Ends all children. No child can be started while the returned guard exists.
#[cfg(unix)]
pub fn end_all() -> impl Drop {
    let children = lock(&CHILDREN);
    for child in &*children {
        end(child);
    }
    children
}
