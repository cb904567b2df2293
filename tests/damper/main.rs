//! Tests of the damper: its laws, accuracy, safety and encodings.

mod accuracy;
mod accuracy_figure;
mod bank;
mod changed_image;
mod contract;
mod disc;
mod energy;
mod failing_dampers;
mod flipped_bits;
mod force_limit;
mod image;
mod integrity;
mod maxwell;
mod offset;
mod oil;
mod parameters;
mod properties;
mod published;
mod random_dampers;
mod searched;
mod static_forces;
mod yardstick;
