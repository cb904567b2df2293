//! Indices by which a pair or a ride is judged, one a file.

pub mod conicity;
