//! The track: layout, spectra, generated and measured irregularities, defects.

mod defects;
mod generation;
mod layout;
mod measured;
mod spectrum;
mod whole;
