//! Child processes, which end with this one: when their owner drops them, and when the command is
//! interrupted.

use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The running children. A thread that starts or drops one holds the lock while it does, so that an
/// interruption finds each of them either in the list or ended.
static CHILDREN: Mutex<Vec<Arc<Mutex<Child>>>> = Mutex::new(Vec::new());

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A child process, ended when dropped.
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

    /// How it ended, if it has.
    pub(crate) fn ended(&self) -> Option<ExitStatus> {
        lock(&self.0).try_wait().ok().flatten()
    }

    /// The first `most` bytes of what one that ended wrote to a piped standard error.
    pub(crate) fn errors(&self, most: u64) -> String {
        let mut text = String::new();
        if let Some(errors) = lock(&self.0).stderr.as_mut() {
            let _ = errors.take(most).read_to_string(&mut text);
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

/// One that has ended already is left as it is.
fn end(child: &Mutex<Child>) {
    let mut child = lock(child);
    let _ = child.kill();
    let _ = child.wait();
}

/// Ends all children; no child can be started while the returned guard lives.
#[cfg(unix)]
pub fn end_all() -> impl Drop {
    let children = lock(&CHILDREN);
    for child in &*children {
        end(child);
    }
    children
}
