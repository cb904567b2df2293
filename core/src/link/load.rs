//! A load in progress.

use core::ops::Range;

use super::message::Header;
use crate::encoding::Loading;
use crate::health::HealthLoading;

/// A load in progress, in slices.
#[derive(Clone, Debug)]
pub(super) struct Load {
    pub(super) header: Header,
    pub(super) damper: u8,
    /// Range of the image in the reader's message.
    pub(super) image: Range<usize>,
    pub(super) progress: Progress,
}

/// Progress of loading a damper or a health model.
#[derive(Clone, Debug)]
pub(super) enum Progress {
    Damper(Loading),
    Health(HealthLoading),
}

impl Load {
    pub(super) const NONE: Self = Self {
        header: Header {
            session: 0,
            sequence: 0,
        },
        damper: 0,
        image: 0..0,
        progress: Progress::Damper(Loading::START),
    };
}
