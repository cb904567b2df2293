//! Records from a real-time thread to another one, through memory that is there before the run.

use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::time::Duration;

/// How long the reading thread sleeps when there is no record.
const NAP: Duration = Duration::from_millis(1);

/// The end of the real-time thread. [`Self::give`] allocates nothing, calls nothing of the system and waits for nobody, as long as a record
/// is free.
#[derive(Debug)]
pub struct Giver<R> {
    free: Receiver<Box<R>>,
    filled: SyncSender<Box<R>>,
    waits: u64,
}

/// The end of the thread that reads the records.
#[derive(Debug)]
pub struct Taker<R> {
    filled: Receiver<Box<R>>,
    free: SyncSender<Box<R>>,
}

/// The thread that reads the records has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the thread that reads the records has ended")]
pub struct NobodyReads;

/// Both ends, with as many records as the reading thread may fall behind by.
///
/// ```
/// use dashpot_realtime::handover::handover;
/// let (mut giver, taker) = handover(vec![0_u32; 4]);
/// let reading = std::thread::spawn(move || {
///     let mut read = Vec::new();
///     while taker.take(|record| read.push(*record)) {}
///     read
/// });
/// for tick in 0..100 {
///     giver.give(|record| *record = tick)?;
/// }
/// drop(giver);
/// assert_eq!(reading.join().unwrap(), (0..100).collect::<Vec<_>>());
/// # Ok::<(), dashpot_realtime::handover::NobodyReads>(())
/// ```
pub fn handover<R>(records: Vec<R>) -> (Giver<R>, Taker<R>) {
    let (to_filled, filled) = sync_channel(records.len());
    let (to_free, free) = sync_channel(records.len());
    for record in records {
        // There is room for all of them, and the other end is there.
        let _is_sent = to_free.try_send(Box::new(record));
    }
    let giver = Giver {
        free,
        filled: to_filled,
        waits: 0,
    };
    let taker = Taker {
        filled,
        free: to_free,
    };
    (giver, taker)
}

impl<R> Giver<R> {
    /// Has `fill` write a record, which the other thread then reads. Waits while no record is free, and counts that.
    ///
    /// # Errors
    /// The other thread has ended.
    pub fn give(&mut self, fill: impl FnOnce(&mut R)) -> Result<(), NobodyReads> {
        let mut record = match self.free.try_recv() {
            Ok(record) => record,
            Err(TryRecvError::Disconnected) => return Err(NobodyReads),
            Err(TryRecvError::Empty) => {
                self.waits += 1;
                self.free.recv().map_err(|_| NobodyReads)?
            }
        };
        fill(&mut record);
        self.filled.try_send(record).map_err(|_| NobodyReads)
    }

    /// Records for which [`Self::give`] had to wait, because the reading thread had fallen behind.
    pub fn waits(&self) -> u64 {
        self.waits
    }
}

impl<R> Taker<R> {
    /// Has `read` read the next record; false once there are no more and the other end is gone.
    ///
    /// It looks for records now and then, and never blocks on them: the real-time thread would have to wake it.
    pub fn take(&self, read: impl FnOnce(&R)) -> bool {
        loop {
            match self.filled.try_recv() {
                Ok(record) => {
                    read(&record);
                    // The other end may be gone already.
                    let _is_free = self.free.try_send(record);
                    return true;
                }
                Err(TryRecvError::Disconnected) => return false,
                Err(TryRecvError::Empty) => std::thread::sleep(NAP),
            }
        }
    }
}
