//! The bytes of a recording: decompressed, counted, and of what kind they are.

use std::cell::Cell;
use std::io::{self, Cursor, Read};
use std::rc::Rc;

use flate2::read::MultiGzDecoder;

/// Bytes that tell every kind.
const TELLING: usize = 8;

const GZIP: &[u8] = b"\x1f\x8b";

/// What a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Text, as far as its first bytes tell.
    Text,
    /// ASAM MDF, of version 4.
    Mdf4,
    /// Apache Parquet.
    Parquet,
    /// What is not read, by its name.
    Other(&'static str),
}

/// First bytes of files that are taken for recordings and not read.
const OTHERS: [(&[u8], &str); 9] = [
    (
        b"PK\x03\x04",
        "a zip archive or a workbook of Excel (it starts with PK); unpack it, or save the sheet as CSV",
    ),
    (
        b"\xd0\xcf\x11\xe0",
        "an old workbook of Excel; save the sheet as CSV",
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
        "HDF5 or a MAT-file of version 7.3; export it as Parquet or CSV",
    ),
    (
        b"MATLAB 5",
        "a MAT-file of version 5; export it as Parquet or CSV",
    ),
    (b"TDSm", "TDMS of LabVIEW; export it as Parquet or CSV"),
    (
        b"UnFinMF ",
        "MDF4 that its writer did not finish; open and save it with the program that wrote it",
    ),
];

/// The bytes of a file from the first on, whose first are known.
pub(super) struct Stream {
    head: Vec<u8>,
    rest: Box<dyn Read>,
    count: Count,
    #[cfg_attr(not(any(feature = "mdf", feature = "parquet")), allow(dead_code))]
    is_compressed: bool,
}

/// Bytes of the file read so far, for a progress bar.
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

/// Says of errors that they are of the compression.
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
    /// The bytes of `source`, decompressed where they are compressed with gzip.
    ///
    /// # Errors
    /// The source fails.
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
        // No more than tells the kind: a logger at the other end of a pipe may be writing still.
        rest.by_ref().take(TELLING as u64).read_to_end(&mut head)?;
        Ok(Self {
            head,
            rest,
            count: Rc::clone(count),
            is_compressed: false,
        })
    }

    /// What the file is.
    pub(super) fn kind(&self) -> Kind {
        if self.head.starts_with(b"MDF     ") {
            return Kind::Mdf4;
        }
        if self.head.starts_with(b"PAR1") {
            return Kind::Parquet;
        }
        let other = OTHERS
            .iter()
            .find(|(start, _)| self.head.starts_with(start));
        other.map_or(Kind::Text, |(_, name)| Kind::Other(name))
    }

    /// Whether the bytes of the file are others.
    #[cfg(any(feature = "mdf", feature = "parquet"))]
    pub(super) fn is_compressed(&self) -> bool {
        self.is_compressed
    }

    /// The first bytes, [`TELLING`] of them unless there are fewer.
    pub(super) fn head(&self) -> &[u8] {
        &self.head
    }

    /// The count of bytes read.
    pub(super) fn count(&self) -> Count {
        Rc::clone(&self.count)
    }

    /// All bytes, the first too.
    pub(super) fn into_reader(self) -> Box<dyn Read> {
        Box::new(Cursor::new(self.head).chain(self.rest))
    }
}
