//! Character encodings of text.

use std::borrow::Cow;
use std::io::Read;

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE, WINDOWS_1252};
use encoding_rs_io::DecodeReaderBytesBuilder;

use crate::stream::Stream;

/// Returns the bytes of `stream`, decoded to UTF-8 if `encoding` is given or the text is UTF-16. Other text is not
/// changed, because numbers need no decoding; [`characters`] decodes single cells.
pub(super) fn decoded(stream: Stream, encoding: Option<&'static Encoding>) -> Box<dyn Read> {
    let encoding = encoding.or_else(|| utf_16(stream.head()));
    let bytes = stream.into_reader();
    match encoding {
        None => bytes,
        Some(encoding) => Box::new(
            DecodeReaderBytesBuilder::new()
                .encoding(Some(encoding))
                .strip_bom(true)
                .build(bytes),
        ),
    }
}

/// Detects UTF-16 by its byte order mark or its first bytes. Without a mark, text is UTF-16 if these bytes, read as
/// UTF-16, contain only characters of Latin-1.
fn utf_16(head: &[u8]) -> Option<&'static Encoding> {
    if let Some((encoding, _)) = Encoding::for_bom(head) {
        return Some(encoding).filter(|encoding| [UTF_16LE, UTF_16BE].contains(encoding));
    }
    let pairs = head.as_chunks::<2>().0;
    if pairs.is_empty() {
        None
    } else if pairs.iter().all(|[low, high]| *low > 0 && *high == 0) {
        Some(UTF_16LE)
    } else if pairs.iter().all(|[high, low]| *low > 0 && *high == 0) {
        Some(UTF_16BE)
    } else {
        None
    }
}

/// Decodes a cell. Bytes that are not UTF-8 are read as Windows-1252, a superset of Latin-1. Units in other encodings
/// are then reported as unknown.
pub(super) fn characters(cell: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(cell) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => WINDOWS_1252.decode_without_bom_handling(cell).0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_characters_of_latin_1_in_two_bytes_are_utf_16() {
        for (head, expected) in [
            (&b"t\0i\0m\0e\0"[..], Some(UTF_16LE)),
            (b"\0t\0i\0m\0e", Some(UTF_16BE)),
            (b"\xff\xfet\0", Some(UTF_16LE)),
            (b"\xfe\xff\0t", Some(UTF_16BE)),
            (b"\xef\xbb\xbfti", None),
            (b"time", None),
            (b"t", None),
            (b"", None),
            // Zeros are not characters: a file of zeros is damaged.
            (b"\0\0\0\0\0\0\0\0", None),
            (b"t\0\0\0", None),
            (b"\0t\0\0", None),
        ] {
            assert_eq!(utf_16(head), expected, "{head:?}");
        }
    }
}
