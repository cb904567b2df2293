//! Passes records from a real-time thread to another thread through preallocated memory.

use std::sync::mpsc::{self, SyncSender, TryRecvError, sync_channel};
use std::time::Duration;

/// Time that the receiving thread sleeps if there is no record.
const POLL_INTERVAL: Duration = Duration::from_millis(1);

/// Sender for the real-time thread. While a record is free, [`Self::send`] does not allocate, make system calls or
/// wait.
#[derive(Debug)]
pub struct Sender<R> {
    free: mpsc::Receiver<Box<R>>,
    filled: SyncSender<Box<R>>,
    waits: u64,
    skipped: u64,
}

/// What [`Receiver::try_receive`] found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Received {
    /// A record.
    Record,
    /// No record yet.
    Nothing,
    /// There are no more records, and the sender is dropped.
    Ended,
}

/// Receiver for the thread that reads the records.
#[derive(Debug)]
pub struct Receiver<R> {
    filled: mpsc::Receiver<Box<R>>,
    free: SyncSender<Box<R>>,
}

/// The thread that reads the records has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the thread that reads the records has ended")]
pub struct ReaderEnded;

/// Creates a sender and a receiver. `records` are the preallocated records; their number is how far the receiver may
/// fall behind.
///
/// ```
/// use dashpot_realtime::handover::handover;
/// let (mut sender, receiver) = handover(vec![0_u32; 4]);
/// let reader = std::thread::spawn(move || {
///     let mut read = Vec::new();
///     while receiver.receive(|record| read.push(*record)) {}
///     read
/// });
/// for tick in 0..100 {
///     sender.send(|record| *record = tick)?;
/// }
/// drop(sender);
/// assert_eq!(reader.join().unwrap(), (0..100).collect::<Vec<_>>());
/// # Ok::<(), dashpot_realtime::handover::ReaderEnded>(())
/// ```
pub fn handover<R>(records: Vec<R>) -> (Sender<R>, Receiver<R>) {
    let (to_filled, filled) = sync_channel(records.len());
    let (to_free, free) = sync_channel(records.len());
    for record in records {
        // This cannot fail: the channel has room for all records, and its other end exists.
        let _is_sent = to_free.try_send(Box::new(record));
    }
    let sender = Sender {
        free,
        filled: to_filled,
        waits: 0,
        skipped: 0,
    };
    let receiver = Receiver {
        filled,
        free: to_free,
    };
    (sender, receiver)
}

impl<R> Sender<R> {
    /// Lets `fill` write a record and sends it. If no record is free, this waits and counts the wait.
    ///
    /// # Errors
    /// The other thread has ended.
    pub fn send(&mut self, fill: impl FnOnce(&mut R)) -> Result<(), ReaderEnded> {
        let mut record = match self.free.try_recv() {
            Ok(record) => record,
            Err(TryRecvError::Disconnected) => return Err(ReaderEnded),
            Err(TryRecvError::Empty) => {
                self.waits += 1;
                self.free.recv().map_err(|_| ReaderEnded)?
            }
        };
        fill(&mut record);
        self.filled.try_send(record).map_err(|_| ReaderEnded)
    }

    /// Like [`Self::send`], but never waits: if no record is free, the record is left out and counted.
    ///
    /// # Errors
    /// The other thread has ended.
    pub fn send_or_skip(&mut self, fill: impl FnOnce(&mut R)) -> Result<(), ReaderEnded> {
        match self.free.try_recv() {
            Ok(mut record) => {
                fill(&mut record);
                self.filled.try_send(record).map_err(|_| ReaderEnded)
            }
            Err(TryRecvError::Disconnected) => Err(ReaderEnded),
            Err(TryRecvError::Empty) => {
                self.skipped += 1;
                Ok(())
            }
        }
    }

    /// Number of records that [`Self::send_or_skip`] left out.
    pub fn skipped(&self) -> u64 {
        self.skipped
    }

    /// Number of records for which [`Self::send`] had to wait because the receiver had fallen behind.
    pub fn waits(&self) -> u64 {
        self.waits
    }
}

impl<R> Receiver<R> {
    /// Passes the next record to `read`. Returns false when there are no more records and the sender is dropped.
    ///
    /// It polls for records instead of blocking, so that the real-time thread does not have to wake it.
    pub fn receive(&self, read: impl FnOnce(&R)) -> bool {
        let mut read = Some(read);
        loop {
            let taken = self.try_receive(|record| {
                if let Some(read) = read.take() {
                    read(record);
                }
            });
            match taken {
                Received::Record => return true,
                Received::Ended => return false,
                Received::Nothing => std::thread::sleep(POLL_INTERVAL),
            }
        }
    }

    /// Passes the next record to `read` if there is one; does not wait.
    ///
    /// ```
    /// use dashpot_realtime::handover::{Received, handover};
    /// let (mut sender, receiver) = handover(vec![0_u32; 1]);
    /// assert_eq!(receiver.try_receive(|_| ()), Received::Nothing);
    /// sender.send_or_skip(|record| *record = 7)?;
    /// sender.send_or_skip(|record| *record = 8)?;
    /// assert_eq!(sender.skipped(), 1);
    /// assert_eq!(receiver.try_receive(|record| assert_eq!(*record, 7)), Received::Record);
    /// drop(sender);
    /// assert_eq!(receiver.try_receive(|_| ()), Received::Ended);
    /// # Ok::<(), dashpot_realtime::handover::ReaderEnded>(())
    /// ```
    pub fn try_receive(&self, read: impl FnOnce(&R)) -> Received {
        match self.filled.try_recv() {
            Ok(record) => {
                read(&record);
                // The sender may already be dropped.
                let _is_free = self.free.try_send(record);
                Received::Record
            }
            Err(TryRecvError::Disconnected) => Received::Ended,
            Err(TryRecvError::Empty) => Received::Nothing,
        }
    }
}
