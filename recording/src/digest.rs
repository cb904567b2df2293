//! Digest of a file.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use dashpot_files::FileError;
use sha2::{Digest, Sha256};

/// Bytes read at a time.
const BLOCK: usize = 1 << 16;

/// Returns the SHA-256 of the file at `path`, in hexadecimal digits as `sha256sum` prints them.
///
/// # Errors
/// The file cannot be read.
pub fn sha256(path: &Path) -> Result<String, FileError> {
    let in_file = |error: io::Error| FileError::in_file(path, error);
    let mut file = File::open(path).map_err(in_file)?;
    let mut digest = Sha256::new();
    let mut block = vec![0; BLOCK];
    loop {
        match file.read(&mut block).map_err(in_file)? {
            0 => break,
            count => digest.update(&block[..count]),
        }
    }
    Ok(dashpot_files::hexadecimal(&digest.finalize()))
}

/// Returns the SHA-256 of bytes, in hexadecimal digits.
///
/// ```
/// let digest = dashpot_recording::digest::sha256_of(b"abc");
/// assert_eq!(&digest[..8], "ba7816bf"); // FIPS 180-2, example 1
/// ```
pub fn sha256_of(bytes: &[u8]) -> String {
    dashpot_files::hexadecimal(&Sha256::digest(bytes))
}
