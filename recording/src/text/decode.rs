//! Characters of text: UTF-16 and other encodings made UTF-8.

use std::borrow::Cow;
use std::io::Read;

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE, WINDOWS_1252};
use encoding_rs_io::DecodeReaderBytesBuilder;

use super::super::stream::Stream;

/// The bytes of `stream` with text in UTF-8 or a superset of ASCII, whose cells [`characters`] reads: only that of an `encoding`
/// that is named or can be told is decoded, which numbers need not.
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

/// The order of bytes of UTF-16: by the mark, or because all characters of the start are Latin.
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

/// A cell as characters: what is not UTF-8 is taken for Windows-1252, which has Latin-1 in it. Units of other encodings are not known
/// then, and told so.
pub(super) fn characters(cell: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(cell) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => WINDOWS_1252.decode_without_bom_handling(cell).0,
    }
}
