//! All viewers of a server.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::outbox::{Burst, Outbox};
use crate::viewer::ViewerId;
use crate::wire;

#[derive(Default)]
struct Viewers {
    present: BTreeMap<ViewerId, Arc<Outbox>>,
    came: u64,
    most: u64,
    lost_frames_of_the_gone: u64,
}

/// Numbers of viewers over the life of a server.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ViewerCount {
    /// Connected now.
    pub present: u64,
    /// Connected at some time.
    pub came: u64,
    /// Greatest number connected at once.
    pub most: u64,
    /// Frames lost by all of them, because they read too slowly.
    pub lost_frames: u64,
}

/// Sends to viewers. Nothing here waits for one.
#[derive(Clone, Default)]
pub struct Hub {
    viewers: Arc<Mutex<Viewers>>,
}

impl Hub {
    fn lock(&self) -> MutexGuard<'_, Viewers> {
        self.viewers.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn join(&self) -> (ViewerId, Arc<Outbox>) {
        let mut viewers = self.lock();
        viewers.came += 1;
        let (viewer, outbox) = (ViewerId(viewers.came), Arc::default());
        viewers.present.insert(viewer, Arc::clone(&outbox));
        viewers.most = viewers.most.max(viewers.present.len() as u64);
        (viewer, outbox)
    }

    pub(crate) fn leave(&self, viewer: ViewerId) {
        let mut viewers = self.lock();
        if let Some(outbox) = viewers.present.remove(&viewer) {
            viewers.lost_frames_of_the_gone += outbox.lost_frames();
        }
    }

    fn outboxes(&self) -> Vec<(ViewerId, Arc<Outbox>)> {
        let viewers = self.lock();
        let all = viewers.present.iter();
        all.map(|(viewer, outbox)| (*viewer, Arc::clone(outbox)))
            .collect()
    }

    fn outbox(&self, viewer: ViewerId) -> Option<Arc<Outbox>> {
        self.lock().present.get(&viewer).cloned()
    }

    /// Sends the first texts to a viewer; frames follow them.
    pub fn begin(&self, viewer: ViewerId, texts: &[String]) {
        if let Some(outbox) = self.outbox(viewer) {
            outbox.begin(texts.iter().map(|text| wire::text(text).into()));
        }
    }

    /// Sends a text to a viewer, if it is still there.
    pub fn send(&self, viewer: ViewerId, text: &str) {
        if let Some(outbox) = self.outbox(viewer) {
            outbox.text(wire::text(text).into());
        }
    }

    /// Sends a text to all viewers; frames that they have not been sent yet are out of date.
    pub fn begin_anew(&self, text: &str) {
        let bytes: Arc<[u8]> = wire::text(text).into();
        for (_, outbox) in self.outboxes() {
            outbox.begin_anew(Arc::clone(&bytes));
        }
    }

    /// Sends frames to all viewers at once.
    pub fn frames<'a>(&self, frames: impl ExactSizeIterator<Item = &'a [u8]>) {
        let outboxes = self.outboxes();
        if outboxes.is_empty() || frames.len() == 0 {
            return;
        }
        let count = frames.len() as u64;
        let bytes: Arc<[u8]> = wire::binaries(frames).into();
        for (_, outbox) in outboxes {
            outbox.burst(Burst {
                bytes: Arc::clone(&bytes),
                frames: count,
            });
        }
    }

    /// Viewers that are connected, with the frames that each has lost.
    pub fn viewers(&self) -> Vec<(ViewerId, u64)> {
        let all = self.outboxes().into_iter();
        all.map(|(viewer, outbox)| (viewer, outbox.lost_frames()))
            .collect()
    }

    /// Numbers of viewers so far.
    pub fn count(&self) -> ViewerCount {
        let viewers = self.lock();
        let of_present: u64 = viewers
            .present
            .values()
            .map(|outbox| outbox.lost_frames())
            .sum();
        ViewerCount {
            present: viewers.present.len() as u64,
            came: viewers.came,
            most: viewers.most,
            lost_frames: viewers.lost_frames_of_the_gone + of_present,
        }
    }

    /// Lets all connections end after what they still have to send.
    pub(crate) fn end(&self) {
        for (_, outbox) in self.outboxes() {
            outbox.end();
        }
    }
}
