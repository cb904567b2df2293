//! The thicknesses of a pack's shims.

use core::fmt;
use core::ops::{Deref, DerefMut};

/// Largest number of shims in a pack.
pub const MAX_SHIMS: usize = 16;

/// Thickness of each shim of a pack (m), for at most [`MAX_SHIMS`] shims; it can be read and changed as a slice.
///
/// ```
/// use dashpot_core::parameters::Shims;
///
/// const SHIMS: Shims = Shims::new(&[0.4e-3, 0.3e-3]).unwrap();
/// assert_eq!(SHIMS[..], [0.4e-3, 0.3e-3]);
/// assert!(Shims::new(&[0.3e-3; 17]).is_none());
/// ```
#[derive(Clone, Copy, Default)]
pub struct Shims {
    thicknesses_m: [f64; MAX_SHIMS],
    count: usize,
}

impl Shims {
    /// No shims: for a valve whose edge compliance is given.
    pub const EMPTY: Self = Self {
        thicknesses_m: [0.0; MAX_SHIMS],
        count: 0,
    };

    /// Shims of these thicknesses (m); `None` if there are more than [`MAX_SHIMS`].
    pub const fn new(thicknesses_m: &[f64]) -> Option<Self> {
        let mut shims = Self::EMPTY;
        if thicknesses_m.len() > MAX_SHIMS {
            return None;
        }
        while shims.count < thicknesses_m.len() {
            shims.thicknesses_m[shims.count] = thicknesses_m[shims.count];
            shims.count += 1;
        }
        Some(shims)
    }
}

impl Deref for Shims {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        self.thicknesses_m.get(..self.count).unwrap_or_default()
    }
}

impl DerefMut for Shims {
    fn deref_mut(&mut self) -> &mut [f64] {
        self.thicknesses_m.get_mut(..self.count).unwrap_or_default()
    }
}

impl PartialEq for Shims {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl fmt::Debug for Shims {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

#[cfg(feature = "serde")]
mod with_serde {
    use core::fmt;

    use serde::de::{Error, SeqAccess, Visitor};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::{MAX_SHIMS, Shims};

    impl Serialize for Shims {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_seq(self.iter())
        }
    }

    impl<'de> Deserialize<'de> for Shims {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            deserializer.deserialize_seq(Thicknesses)
        }
    }

    struct Thicknesses;

    impl<'de> Visitor<'de> for Thicknesses {
        type Value = Shims;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "at most {MAX_SHIMS} thicknesses")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut thicknesses: A) -> Result<Shims, A::Error> {
            let mut shims = Shims::EMPTY;
            while let Some(thickness) = thicknesses.next_element()? {
                let free = shims.thicknesses_m.get_mut(shims.count);
                *free.ok_or_else(|| A::Error::invalid_length(MAX_SHIMS + 1, &self))? = thickness;
                shims.count += 1;
            }
            Ok(shims)
        }
    }
}
