//! Setters for structs of parameters that may gain fields.

/// Defines `const` methods that replace one field each and return the struct.
macro_rules! setters {
    ($($name:ident sets $field:ident: $type:ty;)*) => {
        $(
            #[doc = concat!("Returns these parameters with another `", stringify!($field), "`.")]
            #[must_use]
            pub const fn $name(mut self, $field: $type) -> Self {
                self.$field = $field;
                self
            }
        )*
    };
}

pub(crate) use setters;
