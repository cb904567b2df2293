//! Functions of every element of an array, for the step.

/// `[T; N]::map` that is always inlined: vector instructions are inlined only into functions that are compiled for them, which
/// the library's are not.
pub trait Each<T, const N: usize> {
    /// The function of every element.
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
