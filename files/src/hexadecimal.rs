//! Bytes as text.

/// Writes bytes as lowercase hexadecimal digits, two per byte.
///
/// ```
/// assert_eq!(dashpot_files::hexadecimal(&[0, 171]), "00ab");
/// ```
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
