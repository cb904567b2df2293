//! An always-inlined `map` for arrays.

/// An array `map` that is always inlined. Vector instructions are inlined only into functions compiled for them, which
/// those of the standard library are not.
pub trait Each<T, const N: usize> {
    /// Applies `function` to every element.
    fn each<U: Copy>(self, function: impl FnMut(T) -> U) -> [U; N];
}

impl<T: Copy, const N: usize> Each<T, N> for [T; N] {
    #[inline(always)]
    fn each<U: Copy>(self, mut function: impl FnMut(T) -> U) -> [U; N] {
        const { assert!(N > 0) }
        let mut results = [function(self[0]); N];
        for k in 1..N {
            results[k] = function(self[k]);
        }
        results
    }
}
