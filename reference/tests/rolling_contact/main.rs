//! Exact theory of rolling contact against tables, closed forms and another solver, and the book of tables against
//! exact theory.

mod book;
mod carter;
mod grid;
mod linear;
mod refinement;
mod sliding;
