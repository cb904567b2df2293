//! Fixed bugs: each file describes the bug and asserts the correct behaviour.

mod bad_first_displacement_pulled;
mod damaged_table_gave_infinite_force;
mod elsewhere;
mod flipped_bit_killed_a_damper;
mod force_limit_beyond_bulk_modulus_gave_nan;
mod frame_beyond_its_end_panicked;
mod nan_in_marked_state_stayed;
mod nan_stayed_in_a_state;
mod unwritten_state_was_stepped;
