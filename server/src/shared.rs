//! What all connections of a server share.

use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::access::Access;
use crate::hub::Hub;
use crate::settings::Page;

/// What all connections share.
pub(crate) struct Shared<H> {
    pub access: Access,
    pub page: Page,
    pub hub: Hub,
    pub handler: H,
    connections: AtomicUsize,
    is_ending: AtomicBool,
}

/// A connection, which is counted while this exists.
pub(crate) struct Counted<H>(Arc<Shared<H>>);

impl<H> Shared<H> {
    pub fn new(access: Access, page: Page, hub: Hub, handler: H) -> Arc<Self> {
        Arc::new(Self {
            access,
            page,
            hub,
            handler,
            connections: AtomicUsize::new(0),
            is_ending: AtomicBool::new(false),
        })
    }

    /// Counts a connection; returns it with the number of those before it.
    pub fn count(self: &Arc<Self>) -> (Counted<H>, usize) {
        let before = self.connections.fetch_add(1, Ordering::SeqCst);
        (Counted(Arc::clone(self)), before)
    }

    /// Connections that are open.
    pub fn connections(&self) -> usize {
        self.connections.load(Ordering::SeqCst)
    }

    /// Accepts no more connections.
    pub fn end(&self) {
        self.is_ending.store(true, Ordering::SeqCst);
    }

    /// True after [`Self::end`].
    pub fn is_ending(&self) -> bool {
        self.is_ending.load(Ordering::SeqCst)
    }
}

impl<H> Deref for Counted<H> {
    type Target = Shared<H>;

    fn deref(&self) -> &Shared<H> {
        &self.0
    }
}

impl<H> Drop for Counted<H> {
    fn drop(&mut self) {
        self.0.connections.fetch_sub(1, Ordering::SeqCst);
    }
}
