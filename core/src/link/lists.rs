//! Lists of bounded length in messages.

use core::fmt;
use core::ops::{Deref, DerefMut};

use heapless::Vec;
use serde::{Deserialize, Serialize};

use super::limits::{MAX_DAMPERS, MAX_SAMPLES};

/// One value for each damper, in the order of the dampers: a slice of at most [`MAX_DAMPERS`] values.
///
/// ```
/// use dashpot_core::link::Reals;
///
/// let displacements_m: Reals = [1e-3, -2e-3].into_iter().collect();
/// assert_eq!(displacements_m[..], [1e-3, -2e-3]);
/// ```
#[derive(Clone, PartialEq, Serialize, Deserialize)]
#[serde(bound(serialize = "T: Serialize", deserialize = "T: Deserialize<'de>"))]
pub struct PerDamper<T>(Vec<T, MAX_DAMPERS>);

/// One recorded tick of a damper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Sample {
    /// Tick count.
    pub tick: u32,
    /// Displacement used (m).
    pub displacement_m: f32,
    /// Force returned (N).
    pub force_n: f32,
    /// Latched [`Status`](crate::Status) bits.
    pub status: u16,
}

/// Samples of one damper, oldest first: a slice of at most [`MAX_SAMPLES`] samples.
#[derive(Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Samples(Vec<Sample, MAX_SAMPLES>);

/// One number for each damper.
pub type Reals = PerDamper<f32>;

impl<T> PerDamper<T> {
    /// An empty list.
    pub const fn new() -> Self {
        Self(Vec::new())
    }
}

impl<T: fmt::Debug> fmt::Debug for PerDamper<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Debug for Samples {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<T> Default for PerDamper<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// Implements a list as a slice that is collected from an iterator.
macro_rules! list {
    ($list:ty, $item:ty, $max:expr $(, $parameter:ident)?) => {
        impl<$($parameter)?> FromIterator<$item> for $list {
            /// Collects the items. Those beyond the capacity are left out.
            fn from_iter<I: IntoIterator<Item = $item>>(items: I) -> Self {
                Self(items.into_iter().take($max).collect())
            }
        }

        impl<$($parameter)?> Deref for $list {
            type Target = [$item];

            fn deref(&self) -> &[$item] {
                &self.0
            }
        }

        impl<$($parameter)?> DerefMut for $list {
            fn deref_mut(&mut self) -> &mut [$item] {
                &mut self.0
            }
        }

        impl<'a $(, $parameter)?> IntoIterator for &'a $list {
            type Item = &'a $item;
            type IntoIter = core::slice::Iter<'a, $item>;

            fn into_iter(self) -> Self::IntoIter {
                self.0.iter()
            }
        }
    };
}

list!(PerDamper<T>, T, MAX_DAMPERS, T);
list!(Samples, Sample, MAX_SAMPLES);
