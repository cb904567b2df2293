//! Numbers of a table whose allowed keys depend on its kind.
//!
//! A tagged enum could do the same, but its errors would give the line of the first table.

/// Numbers given in a table, each taken once.
pub(super) struct Keys {
    /// Words for the owner of the keys, such as `a twist`.
    pub owner: &'static str,
    /// Each key with its number; `None` if it is not given.
    pub given: Vec<(&'static str, Option<f64>)>,
}

impl Keys {
    /// Takes the number of a key that this kind requires.
    pub fn take(&mut self, key: &'static str) -> Result<f64, String> {
        let found = self.given.iter().position(|(name, _)| *name == key);
        let value = found.and_then(|index| self.given.swap_remove(index).1);
        value.ok_or_else(|| format!("{} needs `{key}`", self.owner))
    }

    /// Checks that every given key was taken.
    pub fn end(self) -> Result<(), String> {
        match self.given.iter().find(|(_, value)| value.is_some()) {
            Some((key, _)) => Err(format!("{} has no `{key}`", self.owner)),
            None => Ok(()),
        }
    }
}
