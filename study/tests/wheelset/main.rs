//! Wheelsets under load, and contacts at the ends of profiles.

mod exact;
mod profile_ends;
mod properties;
