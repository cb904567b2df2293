//! The numbers of a table whose kind says which it has.
//!
//! Not an enumeration with a tag, whose errors would name the line of the first table.

/// Numbers that a table gives, each taken once.
pub(super) struct Keys {
    /// What the table is of.
    pub of: &'static str,
    /// Each key with its number if it is given.
    pub given: Vec<(&'static str, Option<f64>)>,
}

impl Keys {
    /// The number of a key that this kind has.
    pub fn take(&mut self, key: &'static str) -> Result<f64, String> {
        let found = self.given.iter().position(|(name, _)| *name == key);
        let value = found.and_then(|index| self.given.swap_remove(index).1);
        value.ok_or_else(|| format!("missing `{key}` of {}", self.of))
    }

    /// Checks that nothing else is given.
    pub fn end(self) -> Result<(), String> {
        match self.given.iter().find(|(_, value)| value.is_some()) {
            Some((key, _)) => Err(format!("`{key}`, which {} has not", self.of)),
            None => Ok(()),
        }
    }
}
