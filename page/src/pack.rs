//! Bytes as text in a page.

use std::io::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;

/// Compresses bytes as gzip, which every browser unpacks, and returns them as base64.
pub(crate) fn packed(bytes: &[u8]) -> String {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    let packed = encoder.write_all(bytes).and_then(|()| encoder.finish());
    // A vector accepts all bytes.
    BASE64_STANDARD.encode(packed.unwrap_or_default())
}
