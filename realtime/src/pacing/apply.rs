//! Applies real-time options to a thread. The system may refuse any of them.

use crate::RealtimeError;
use crate::options::{RealtimeOption, RealtimeOptions};

impl RealtimeOption {
    fn refused(self, reason: String) -> RealtimeError {
        RealtimeError::Refused {
            option: self,
            reason,
        }
    }
}

#[cfg(target_os = "linux")]
impl RealtimeOptions {
    /// Applies the options to the calling thread, starting with the core. Locking applies to the memory of the process.
    ///
    /// # Errors
    /// The system refuses an option; the error states the missing permission.
    pub fn apply(&self) -> Result<(), RealtimeError> {
        if let Some(core) = self.core {
            pin(core)?;
        }
        if self.lock_memory {
            lock_memory()?;
        }
        if let Some(priority) = self.fifo_priority {
            set_fifo(priority)?;
        }
        Ok(())
    }
}

#[cfg(not(target_os = "linux"))]
impl RealtimeOptions {
    /// Applies the options to the calling thread.
    ///
    /// # Errors
    /// At least one option is set; all options need Linux.
    pub fn apply(&self) -> Result<(), RealtimeError> {
        let options = [
            self.fifo_priority.map(RealtimeOption::FifoPriority),
            self.lock_memory.then_some(RealtimeOption::LockMemory),
            self.core.map(RealtimeOption::Core),
        ];
        match options.into_iter().flatten().next() {
            Some(option) => {
                Err(option.refused("not supported on this system; it needs Linux".into()))
            }
            None => Ok(()),
        }
    }
}

#[cfg(target_os = "linux")]
fn pin(core: usize) -> Result<(), RealtimeError> {
    use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
    use nix::unistd::Pid;

    let this_thread = Pid::from_raw(0);
    let refused = |reason: String| RealtimeOption::Core(core).refused(reason);
    let granted = sched_getaffinity(this_thread).map_err(|error| {
        refused(format!(
            "the system does not list the allowed cores: {error}"
        ))
    })?;
    let allowed: Vec<usize> = (0..CpuSet::count())
        .filter(|core| granted.is_set(*core).unwrap_or(false))
        .collect();
    if !allowed.contains(&core) {
        return Err(RealtimeError::Core { core, allowed });
    }
    let mut wanted = CpuSet::new();
    wanted
        .set(core)
        .and_then(|()| sched_setaffinity(this_thread, &wanted))
        .map_err(|error| refused(format!("the system refused: {error}")))
}

#[cfg(target_os = "linux")]
fn lock_memory() -> Result<(), RealtimeError> {
    use nix::sys::mman::{MlockAllFlags, mlockall};
    use nix::sys::resource::{RLIM_INFINITY, Resource, getrlimit};

    mlockall(MlockAllFlags::MCL_CURRENT | MlockAllFlags::MCL_FUTURE).map_err(|error| {
        let limit = match getrlimit(Resource::RLIMIT_MEMLOCK) {
            Ok((RLIM_INFINITY, _)) => "unlimited".to_owned(),
            Ok((soft, _)) => format!("{soft} bytes"),
            Err(error) => error.to_string(),
        };
        RealtimeOption::LockMemory.refused(format!(
            "the system refused ({error}); needs CAP_IPC_LOCK, or RLIMIT_MEMLOCK (`ulimit -l`, now \
             {limit}) above the size of the process"
        ))
    })
}

#[cfg(target_os = "linux")]
fn set_fifo(priority: u8) -> Result<(), RealtimeError> {
    use nix::errno::Errno;
    use nix::sys::resource::{Resource, getrlimit};
    use thread_priority::{
        Error, RealtimeThreadSchedulePolicy, ThreadPriority, ThreadPriorityValue,
        ThreadSchedulePolicy, set_thread_priority_and_policy, thread_native_id,
    };

    let option = RealtimeOption::FifoPriority(priority);
    let refused = |why: String| {
        let limit = getrlimit(Resource::RLIMIT_RTPRIO)
            .map_or_else(|error| error.to_string(), |(soft, _)| soft.to_string());
        option.refused(format!(
            "the system refused ({why}); needs CAP_SYS_NICE, or RLIMIT_RTPRIO (`ulimit -r`, now \
             {limit}) of at least {priority}"
        ))
    };
    let wanted = ThreadPriorityValue::try_from(priority)
        .map_err(|_| option.refused("allowed: 1 to 99".into()))?;
    set_thread_priority_and_policy(
        thread_native_id(),
        ThreadPriority::Crossplatform(wanted),
        ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo),
    )
    .map_err(|error| {
        refused(match error {
            Error::OS(number) => Errno::from_raw(number).to_string(),
            other => other.to_string(),
        })
    })
}
