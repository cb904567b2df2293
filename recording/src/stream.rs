//! Byte stream of a recording: decompresses it, counts bytes and detects the file format.

use std::cell::Cell;
use std::io::{self, Cursor, Read};
use std::rc::Rc;

use flate2::read::MultiGzDecoder;

/// Number of bytes needed to detect most formats.
const SIGNATURE_BYTES: usize = 8;

/// Number of bytes needed to detect the version of an MDF file, which follows [`MDF`] or [`UNFINISHED_MDF`].
const VERSION_BYTES: usize = 12;

/// Start of an MDF file.
pub(super) const MDF: [u8; 8] = *b"MDF     ";

/// Start of an MDF file that its logger did not finish.
pub(super) const UNFINISHED_MDF: [u8; 8] = *b"UnFinMF ";

/// An MDF file of an old version, and a workaround.
const OLD_MDF: &str = "an MDF file of a version before 4; save it as MDF4 with its own software, or with asammdf in \
                       Python: asammdf.MDF(\"run.mdf\").convert(\"4.10\").save(\"run.mf4\")";

const GZIP: &[u8] = b"\x1f\x8b";

/// Format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Text, according to its first bytes.
    Text,
    /// ASAM MDF version 4.
    Mdf4,
    /// Apache Parquet.
    Parquet,
    /// Unsupported format, with its name and a workaround.
    Other(&'static str),
}

/// First bytes of unsupported formats, with their names and workarounds.
const UNSUPPORTED: [(&[u8], &str); 11] = [
    (
        b"PK\x03\x04",
        "a zip archive or an Excel workbook (it starts with PK); unpack it, or save the sheet as CSV",
    ),
    (
        b"\xd0\xcf\x11\xe0",
        "an old Excel workbook; save the sheet as CSV",
    ),
    (
        b"\x28\xb5\x2f\xfd",
        "compressed with Zstandard; decompress it, or pipe it through zstdcat",
    ),
    (
        b"\xfd7zXZ\0",
        "compressed with xz; decompress it, or pipe it through xzcat",
    ),
    (
        b"BZh",
        "compressed with bzip2; decompress it, or pipe it through bzcat",
    ),
    (
        b"\x89HDF\r\n\x1a\n",
        "HDF5 or a MAT-file (version 7.3); export it as Parquet or CSV",
    ),
    (
        b"MATLAB 5",
        "a MAT-file (version 5); export it as Parquet or CSV",
    ),
    (b"TDSm", "LabVIEW TDMS; export it as Parquet or CSV"),
    (
        b"ARROW1\0\0",
        "an Arrow file (Feather); save it as Parquet, with pandas in Python: \
         pandas.read_feather(\"run.feather\").to_parquet(\"run.parquet\")",
    ),
    (
        b"FEA1",
        "an old Feather file (version 1); save it as Parquet, with pandas in Python: \
         pandas.read_feather(\"run.feather\").to_parquet(\"run.parquet\")",
    ),
    (
        b"\xff\xff\xff\xff",
        "an Arrow stream; save it as Parquet, with pyarrow in Python: \
         pyarrow.parquet.write_table(pyarrow.ipc.open_stream(\"run.arrows\").read_all(), \"run.parquet\")",
    ),
];

/// Byte stream of a file, after its first bytes have been inspected.
pub(super) struct Stream {
    head: Vec<u8>,
    rest: Box<dyn Read>,
    count: Count,
    #[cfg_attr(not(any(feature = "mdf", feature = "parquet")), allow(dead_code))]
    is_compressed: bool,
}

/// Number of bytes of the file read so far, for a progress bar.
pub(super) type Count = Rc<Cell<u64>>;

struct Counted {
    source: Box<dyn Read>,
    count: Count,
}

impl Read for Counted {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.source.read(buffer)?;
        self.count.set(self.count.get() + length as u64);
        Ok(length)
    }
}

/// Decompressor whose errors mention the compression.
struct Decompressed(MultiGzDecoder<Box<dyn Read>>);

impl Read for Decompressed {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.read(buffer).map_err(|error| {
            let reason = format!("the gzip compression is damaged or cut off: {error}");
            io::Error::new(error.kind(), reason)
        })
    }
}

impl Stream {
    /// Wraps `source` and decompresses gzip.
    ///
    /// # Errors
    /// Returns an error if the source cannot be read.
    pub(super) fn new(source: Box<dyn Read>) -> io::Result<Self> {
        let count = Count::default();
        let counted = Box::new(Counted {
            source,
            count: Rc::clone(&count),
        });
        let raw = Self::peeked(counted, &count)?;
        if !raw.head.starts_with(GZIP) {
            return Ok(raw);
        }
        let bytes: Box<dyn Read> = Box::new(Cursor::new(raw.head).chain(raw.rest));
        let decompressed = Decompressed(MultiGzDecoder::new(bytes));
        let mut inner = Self::peeked(Box::new(decompressed), &count)?;
        inner.is_compressed = true;
        Ok(inner)
    }

    fn peeked(mut rest: Box<dyn Read>, count: &Count) -> io::Result<Self> {
        let mut head = Vec::new();
        // Read no more than needed: a logger at the other end of a pipe may still be writing.
        rest.by_ref()
            .take(SIGNATURE_BYTES as u64)
            .read_to_end(&mut head)?;
        if head == MDF || head == UNFINISHED_MDF {
            rest.by_ref()
                .take((VERSION_BYTES - SIGNATURE_BYTES) as u64)
                .read_to_end(&mut head)?;
        }
        Ok(Self {
            head,
            rest,
            count: Rc::clone(count),
            is_compressed: false,
        })
    }

    /// Format of the file.
    pub(super) fn kind(&self) -> Kind {
        if self.head.starts_with(&MDF) || self.head.starts_with(&UNFINISHED_MDF) {
            return match self.head.get(MDF.len()) {
                Some(b'2' | b'3') => Kind::Other(OLD_MDF),
                _ => Kind::Mdf4,
            };
        }
        if self.head.starts_with(b"PAR1") {
            return Kind::Parquet;
        }
        let other = UNSUPPORTED
            .iter()
            .find(|(start, _)| self.head.starts_with(start));
        other.map_or(Kind::Text, |(_, name)| Kind::Other(name))
    }

    /// True if the file itself is compressed.
    #[cfg(any(feature = "mdf", feature = "parquet"))]
    pub(super) fn is_compressed(&self) -> bool {
        self.is_compressed
    }

    /// First bytes of the file, as many as were needed to detect its format.
    pub(super) fn head(&self) -> &[u8] {
        &self.head
    }

    /// Returns the shared count of the bytes read.
    pub(super) fn count(&self) -> Count {
        Rc::clone(&self.count)
    }

    /// Returns a reader of all bytes, including the first.
    pub(super) fn into_reader(self) -> Box<dyn Read> {
        Box::new(Cursor::new(self.head).chain(self.rest))
    }
}

#[cfg(all(test, any(feature = "mdf", feature = "parquet")))]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    /// Compressed files need a temporary copy for random access; others must not be copied, however large they are.
    #[test]
    fn only_gzip_is_compressed() {
        let mut gzip = GzEncoder::new(Vec::new(), Compression::default());
        gzip.write_all(b"PAR1").expect("memory");
        let gzip = gzip.finish().expect("memory");
        for (bytes, is_compressed) in [(b"PAR1".to_vec(), false), (gzip, true)] {
            let stream = Stream::new(Box::new(Cursor::new(bytes))).expect("memory");
            assert_eq!(stream.kind(), Kind::Parquet);
            assert_eq!(stream.is_compressed(), is_compressed);
        }
    }
}
