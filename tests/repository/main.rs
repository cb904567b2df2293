//! Rules for the repository as a whole: crates, modules, the architecture drawing, the book, licences, packages, and
//! seeds of the fuzz targets.

mod architecture;
mod book;
mod crates;
mod errors;
mod files;
mod fuzz_seeds;
mod indices;
mod licences;
mod module_of_the_page;
mod modules;
mod published;
mod readme;
mod release;
mod rust_version;
mod source;
mod workflows;
mod workspaces;
mod xcp_seeds;
