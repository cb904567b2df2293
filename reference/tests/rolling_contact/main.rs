//! Exact theory of rolling contact against tables, closed forms and another solver; the book of tables against it.

mod book;
mod carter;
mod grid;
mod linear;
mod refinement;
mod sliding;
