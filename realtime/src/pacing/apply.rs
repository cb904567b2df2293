//! Applies real-time options to a thread. The system may refuse any of them.

#[cfg(target_os = "linux")]
use std::path::Path;

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
        if self.no_deep_sleep {
            forbid_deep_sleep(Path::new(WAKE_LATENCY))?;
        }
        Ok(())
    }
}

#[cfg(not(target_os = "linux"))]
impl RealtimeOptions {
    /// Applies the options to the calling thread.
    ///
    /// # Errors
    /// An option is set: every option needs Linux.
    pub fn apply(&self) -> Result<(), RealtimeError> {
        let options = [
            self.fifo_priority.map(RealtimeOption::FifoPriority),
            self.lock_memory.then_some(RealtimeOption::LockMemory),
            self.core.map(RealtimeOption::Core),
            self.no_deep_sleep.then_some(RealtimeOption::NoDeepSleep),
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

/// Device of the kernel that takes the longest time (us) in which a processor may wake.
#[cfg(target_os = "linux")]
const WAKE_LATENCY: &str = "/dev/cpu_dma_latency";

/// Requests waking in 0 us. The request holds as long as the file is open, so it is open until the process ends.
#[cfg(target_os = "linux")]
fn forbid_deep_sleep(device: &Path) -> Result<(), RealtimeError> {
    use std::fs::OpenOptions;
    use std::io::Write;

    let request = OpenOptions::new()
        .write(true)
        .open(device)
        .and_then(|mut file| {
            file.write_all(&0_i32.to_ne_bytes())?;
            Ok(file)
        });
    match request {
        Ok(file) => {
            std::mem::forget(file);
            Ok(())
        }
        Err(error) => Err(RealtimeOption::NoDeepSleep.refused(format!(
            "the system refused ({error}); needs write access to {}",
            device.display()
        ))),
    }
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

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::forbid_deep_sleep;

    #[test]
    fn zero_microseconds_are_requested_of_the_device() {
        let folder = tempfile::tempdir().unwrap();
        let device = folder.path().join("cpu_dma_latency");
        std::fs::write(&device, [1; 4]).unwrap();
        forbid_deep_sleep(&device).unwrap();
        assert_eq!(std::fs::read(&device).unwrap(), [0; 4]);
    }

    #[test]
    fn a_missing_device_is_named() {
        let missing = std::path::Path::new("/dev/no such device");
        let error = forbid_deep_sleep(missing).unwrap_err().to_string();
        assert!(
            error.contains("needs write access to /dev/no such device"),
            "{error}"
        );
    }
}
