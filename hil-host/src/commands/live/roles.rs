//! Who operates.

use dashpot_server::{ViewerId, WantedRole};

/// One viewer operates, the others watch.
#[derive(Debug, Default)]
pub(super) struct Roles {
    operator: Option<ViewerId>,
}

impl Roles {
    /// Takes a viewer in, who operates if nobody does and it does not only want to watch.
    pub fn join(&mut self, viewer: ViewerId, wanted: WantedRole) {
        if wanted != WantedRole::Viewer {
            self.operator.get_or_insert(viewer);
        }
    }

    /// A viewer has left.
    pub fn leave(&mut self, viewer: ViewerId) {
        self.operator = self.operator.filter(|operator| *operator != viewer);
    }

    /// Lets a viewer operate, if nobody else does.
    ///
    /// # Errors
    /// Another viewer operates.
    pub fn take_over(&mut self, viewer: ViewerId) -> Result<(), &'static str> {
        match self.operator.get_or_insert(viewer) {
            operator if *operator == viewer => Ok(()),
            _ => Err("somebody else operates; the role is free when they leave"),
        }
    }

    /// True if this viewer operates.
    pub fn is_operator(&self, viewer: ViewerId) -> bool {
        self.operator == Some(viewer)
    }

    /// `operator` or `viewer`.
    pub fn of(&self, viewer: ViewerId) -> &'static str {
        match self.is_operator(viewer) {
            true => "operator",
            false => "viewer",
        }
    }
}

#[cfg(test)]
mod tests {
    use dashpot_server::{ViewerId, WantedRole};

    use super::Roles;

    #[test]
    fn the_first_operates_until_it_leaves() {
        let mut roles = Roles::default();
        let [watching, first, second] = [0, 1, 2].map(ViewerId);
        roles.join(watching, WantedRole::Viewer);
        roles.join(first, WantedRole::Any);
        roles.join(second, WantedRole::Operator);
        assert_eq!(
            [watching, first, second].map(|id| roles.of(id)),
            ["viewer", "operator", "viewer"]
        );
        assert!(roles.take_over(second).is_err());
        roles.leave(watching);
        assert!(roles.is_operator(first));
        roles.leave(first);
        assert!(!roles.is_operator(second));
        assert_eq!(roles.take_over(second), Ok(()));
        assert_eq!(roles.take_over(second), Ok(()));
    }
}
