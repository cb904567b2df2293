//! What a viewer has not been sent yet. Putting something in never waits for the viewer.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Bursts of frames that wait for a viewer: a quarter of a second at 60 a second. The socket buffers more.
const MAX_BURSTS: usize = 16;

/// Texts that wait for a viewer. One who reads none of them has vanished.
const MAX_TEXTS: usize = 64;

/// Frames that go out together.
#[derive(Clone)]
pub(crate) struct Burst {
    pub bytes: Arc<[u8]>,
    pub frames: u64,
}

#[derive(Default)]
struct Waiting {
    texts: VecDeque<Arc<[u8]>>,
    bursts: VecDeque<Burst>,
    /// Answers of the protocol itself, such as pongs.
    replies: Vec<u8>,
    /// Frames need what explains them, which are texts.
    has_begun: bool,
    lost_frames: u64,
    is_ending: bool,
    is_over: bool,
}

/// What comes next.
pub(crate) enum Next {
    /// Bytes to send.
    Send(Vec<Arc<[u8]>>),
    /// Nothing came for a while.
    Nothing,
    /// Everything is sent, and the connection ends.
    End,
}

/// The waiting messages of a viewer.
#[derive(Default)]
pub(crate) struct Outbox {
    waiting: Mutex<Waiting>,
    changed: Condvar,
}

impl Outbox {
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(&self, change: impl FnOnce(&mut Waiting)) {
        change(&mut self.lock());
        self.changed.notify_one();
    }

    /// Puts a text in.
    pub fn text(&self, bytes: Arc<[u8]>) {
        self.change(|waiting| {
            waiting.texts.push_back(bytes);
            waiting.is_over |= waiting.texts.len() > MAX_TEXTS;
        });
    }

    /// Lets frames follow what is in now.
    pub fn begin(&self, texts: impl Iterator<Item = Arc<[u8]>>) {
        self.change(|waiting| {
            waiting.texts.extend(texts);
            waiting.has_begun = true;
        });
    }

    /// Puts a text in, with which the frames that wait are out of date.
    pub fn begin_anew(&self, bytes: Arc<[u8]>) {
        self.change(|waiting| waiting.bursts.clear());
        self.text(bytes);
    }

    /// Puts frames in; the oldest are lost if too many wait.
    pub fn burst(&self, burst: Burst) {
        self.change(|waiting| {
            if !waiting.has_begun {
                return;
            }
            waiting.bursts.push_back(burst);
            if waiting.bursts.len() > MAX_BURSTS {
                let lost = waiting.bursts.pop_front();
                waiting.lost_frames += lost.map_or(0, |burst| burst.frames);
            }
        });
    }

    /// Puts bytes of the protocol itself in.
    pub fn reply(&self, bytes: &[u8]) {
        self.change(|waiting| waiting.replies.extend(bytes));
    }

    /// Lets the connection end after what waits.
    pub fn end(&self) {
        self.change(|waiting| waiting.is_ending = true);
    }

    /// Ends the connection at once.
    pub fn give_up(&self) {
        self.change(|waiting| waiting.is_over = true);
    }

    /// Frames that the viewer has lost.
    pub fn lost_frames(&self) -> u64 {
        self.lock().lost_frames
    }

    /// Waits up to `most` for something to send.
    pub fn next(&self, most: Duration) -> Next {
        let is_idle = |waiting: &mut Waiting| {
            waiting.texts.is_empty()
                && waiting.bursts.is_empty()
                && waiting.replies.is_empty()
                && !waiting.is_ending
                && !waiting.is_over
        };
        let waited = self.changed.wait_timeout_while(self.lock(), most, is_idle);
        let (mut waiting, _) = waited.unwrap_or_else(PoisonError::into_inner);
        if waiting.is_over {
            return Next::End;
        }
        let mut parts: Vec<Arc<[u8]>> = waiting.texts.drain(..).collect();
        parts.extend(waiting.bursts.drain(..).map(|burst| burst.bytes));
        if !waiting.replies.is_empty() {
            parts.push(std::mem::take(&mut waiting.replies).into());
        }
        match parts.is_empty() {
            true if waiting.is_ending => Next::End,
            true => Next::Nothing,
            false => Next::Send(parts),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::{Burst, MAX_BURSTS, MAX_TEXTS, Next, Outbox};

    const NOW: Duration = Duration::ZERO;

    fn burst(frames: u64) -> Burst {
        Burst {
            bytes: [0].into(),
            frames,
        }
    }

    #[test]
    fn frames_begin_after_the_first_texts_and_the_oldest_are_lost() {
        let outbox = Outbox::default();
        outbox.burst(burst(1));
        assert!(matches!(outbox.next(NOW), Next::Nothing));
        outbox.begin([[1].into()].into_iter());
        for _ in 0..MAX_BURSTS + 3 {
            outbox.burst(burst(2));
        }
        assert_eq!(outbox.lost_frames(), 6);
        let Next::Send(parts) = outbox.next(NOW) else {
            panic!("nothing to send");
        };
        assert_eq!(parts.len(), 1 + MAX_BURSTS);
        assert_eq!(&*parts[0], [1]);
    }

    #[test]
    fn frames_before_a_new_beginning_are_not_sent_after_it() {
        let outbox = Outbox::default();
        outbox.begin([[1].into()].into_iter());
        outbox.burst(burst(2));
        outbox.begin_anew([2].into());
        outbox.burst(burst(1));
        let Next::Send(parts) = outbox.next(NOW) else {
            panic!("nothing to send");
        };
        assert_eq!(
            parts,
            [[1].into(), [2].into(), [0].into()] as [std::sync::Arc<[u8]>; 3]
        );
        assert_eq!(outbox.lost_frames(), 0);
    }

    #[test]
    fn a_viewer_who_reads_no_texts_is_given_up() {
        let outbox = Outbox::default();
        for _ in 0..=MAX_TEXTS {
            outbox.text([0].into());
        }
        assert!(matches!(outbox.next(NOW), Next::End));
    }

    #[test]
    fn the_end_comes_after_the_last_text() {
        let outbox = Outbox::default();
        outbox.text([0].into());
        outbox.end();
        assert!(matches!(outbox.next(NOW), Next::Send(_)));
        assert!(matches!(outbox.next(NOW), Next::End));
    }
}
