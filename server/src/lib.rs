#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod access;
mod connection;
mod error;
mod hub;
mod outbox;
mod request;
mod response;
mod server;
mod settings;
mod shared;
mod token;
mod viewer;
mod wire;

pub use error::ServerError;
pub use hub::{Hub, ViewerCount};
pub use server::Server;
pub use settings::{Page, Settings};
pub use viewer::{Handler, ViewerId, WantedRole};
