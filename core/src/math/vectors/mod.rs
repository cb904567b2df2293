//! Vectors of a group of dampers.

mod transposes;
mod vector;

use fearless_simd::{f32x8, f64x4};

pub(crate) use transposes::Transposes;
pub(crate) use vector::{Vector, Vectors};

/// Work on whole groups of lanes.
pub(crate) trait GroupWork<T>: Sized {
    /// Does the work for groups of `N` vectors of `W` lanes; returns the rest.
    fn in_groups<V: Vector<T, W>, const W: usize, const N: usize>(self, simd: V::Simd) -> Self;
}

/// Scalars that fill vectors.
pub(crate) trait Groups: Sized {
    /// Does work in groups of the sizes that suit the scalar, the largest first; returns the rest.
    fn in_groups<S: Transposes, K: GroupWork<Self>>(simd: S, work: K) -> K;
}

impl Groups for f32 {
    #[inline(always)]
    fn in_groups<S: Transposes, K: GroupWork<Self>>(simd: S, work: K) -> K {
        let rest = work.in_groups::<f32x8<S>, 8, 2>(simd);
        rest.in_groups::<f32x8<S>, 8, 1>(simd)
    }
}

impl Groups for f64 {
    #[inline(always)]
    fn in_groups<S: Transposes, K: GroupWork<Self>>(simd: S, work: K) -> K {
        work.in_groups::<f64x4<S>, 4, 2>(simd)
    }
}
