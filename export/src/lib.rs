#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod c;
mod error;
pub mod fmu;
mod health;
mod name;
mod provenance;
mod rust;
mod standalone;
mod transfer;
mod word;

pub use c::{c_header, c_source};
pub use error::{ExportError, NameError};
pub use health::{health_c_header, health_c_source, health_rust_source};
pub use name::constant_name;
pub use provenance::Provenance;
pub use rust::rust_source;
pub use standalone::{standalone_header, standalone_source, standalone_table_bytes};
pub use transfer::{transfer_header, transfer_source};
pub use word::Word;
