//! Compares the contact of a wheel with exact theory, in the figures and tables of docs/contact.md.
//!
//! `DASHPOT_BLESS=1 cargo test -p dashpot-reference --test contact_theory` updates them.

mod climbing;
mod document;
mod figures;
mod shifts;
