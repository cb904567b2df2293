//! Tests of the link: frames, the device, and the document that describes them.

mod common;
mod damage;
mod device;
mod document;
mod frame;
mod health;
mod held_force;
mod load;
mod running;
