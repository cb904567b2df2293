//! Rules that the repository as a whole keeps: crates, modules, drawing, licences, packages, seeds of the fuzz targets.

mod architecture;
mod crates;
mod files;
mod fuzz_seeds;
mod licences;
mod modules;
mod observed;
mod published;
mod rust_version;
mod source;
mod workspaces;
