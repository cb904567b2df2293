//! Compares exact theory of rolling contact with tables, closed forms and another solver, and the book of tables with
//! exact theory.

mod book;
mod carter;
mod grid;
mod linear;
mod refinement;
mod sliding;
