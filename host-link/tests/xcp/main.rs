//! The slave of XCP without sockets, its description for tools, and its server on sockets.

mod commands;
mod description;
mod lists;
mod master;
mod random_packets;
mod server;
mod session;
