//! What the repository says of itself is so: its drawing, its licences, the seeds of its fuzz targets.

mod architecture;
mod fuzz_seeds;
mod licences;
mod observed;
mod workspaces;
