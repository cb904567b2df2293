//! Result codes of `model.h`.

/// The C enumeration `model_result`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelResult {
    /// `MODEL_DONE`.
    Done,
    /// `MODEL_NO_VARIABLE`.
    NoVariable,
    /// `MODEL_READ_ONLY`.
    ReadOnly,
    /// `MODEL_OUT_OF_RANGE`.
    OutOfRange,
    /// `MODEL_OTHER`.
    Other,
}
