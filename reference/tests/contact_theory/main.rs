//! The contact of a wheel compared with exact theory, in figures and a table of docs/contact.md.
//!
//! `DASHPOT_BLESS=1 cargo test -p dashpot-reference --test contact_theory` updates them.

mod climbing;
mod document;
mod figures;
mod shifts;
