//! Small MDF4 files with any channels, written block by block according to ASAM MDF 4.1, for features that no available
//! program writes.

use std::path::Path;

/// A channel: the type of its values and their position in the record.
pub struct Channel {
    pub name: String,
    /// `cn_type`: 0 a value, 2 the time, 3 a virtual time, 6 a virtual value (both count rows).
    pub kind: u8,
    /// `cn_data_type`: 0 and 1 unsigned integers, 2 and 3 signed integers, 4 and 5 floats; odd types are big-endian.
    pub number: u8,
    pub byte: u32,
    pub bit: u8,
    pub bits: u32,
    pub unit: &'static str,
    /// Offset and factor of the values.
    pub linear: Option<[f64; 2]>,
}

impl Channel {
    /// Time channel: a double at the start of the record.
    pub fn time() -> Self {
        Self {
            kind: 2,
            unit: "s",
            ..Self::value("time", 4, [0, 0, 64])
        }
    }

    /// Length channel (m) at a byte and bit offset, with this number of bits.
    pub fn value(name: &str, number: u8, [byte, bit, bits]: [u32; 3]) -> Self {
        Self {
            name: name.into(),
            kind: 0,
            number,
            byte,
            bit: u8::try_from(bit).unwrap(),
            bits,
            unit: "m",
            linear: None,
        }
    }
}

/// Sequence of blocks, each written before those that link to it.
struct Blocks(Vec<u8>);

impl Blocks {
    fn add(&mut self, mark: &[u8; 4], links: &[u64], data: &[u8]) -> u64 {
        self.0.resize(self.0.len().next_multiple_of(8), 0);
        let at = self.0.len() as u64;
        self.0.extend(block(mark, links, data));
        at
    }

    fn text(&mut self, text: &str) -> u64 {
        let mut bytes = text.as_bytes().to_vec();
        bytes.resize((bytes.len() + 1).next_multiple_of(8), 0);
        self.add(b"##TX", &[], &bytes)
    }

    fn channel(&mut self, following: u64, channel: &Channel) -> u64 {
        let conversion = channel.linear.map_or(0, |[offset, factor]| {
            let mut data = vec![1, 0, 0, 0, 0, 0, 2, 0];
            for number in [0.0, 0.0, offset, factor] {
                data.extend(number.to_le_bytes());
            }
            self.add(b"##CC", &[0; 4], &data)
        });
        let sync = u8::from([2, 3].contains(&channel.kind));
        let mut data = vec![channel.kind, sync, channel.number, channel.bit];
        data.extend(channel.byte.to_le_bytes());
        data.extend(channel.bits.to_le_bytes());
        data.resize(72, 0);
        let (name, unit) = (self.text(&channel.name), self.text(channel.unit));
        self.add(
            b"##CN",
            &[following, 0, name, 0, conversion, 0, unit, 0],
            &data,
        )
    }
}

fn block(mark: &[u8; 4], links: &[u64], data: &[u8]) -> Vec<u8> {
    let length = 24 + 8 * links.len() + data.len();
    let mut bytes = mark.to_vec();
    bytes.resize(8, 0);
    bytes.extend((length as u64).to_le_bytes());
    bytes.extend((links.len() as u64).to_le_bytes());
    bytes.extend(links.iter().flat_map(|link| link.to_le_bytes()));
    bytes.extend(data);
    bytes
}

/// Builds a file with one group of these channels and records; all records have the same length.
pub fn file(channels: &[Channel], records: &[Vec<u8>]) -> Vec<u8> {
    let mut blocks = Blocks(b"MDF     4.10    made    ".to_vec());
    blocks.0.resize(28, 0);
    blocks.0.extend(410_u16.to_le_bytes());
    blocks.0.resize(64 + 24 + 6 * 8 + 32, 0);
    let first = channels
        .iter()
        .rev()
        .fold(0, |following, channel| blocks.channel(following, channel));
    let mut data = vec![0; 8];
    data.extend((records.len() as u64).to_le_bytes());
    data.resize(24, 0);
    data.extend((records[0].len() as u32).to_le_bytes());
    data.resize(32, 0);
    let group = blocks.add(b"##CG", &[0, first, 0, 0, 0, 0], &data);
    let records = blocks.add(b"##DT", &[], &records.concat());
    let whole = blocks.add(b"##DG", &[0, group, records, 0], &[0; 8]);
    let comment = blocks.text("made");
    let history = blocks.add(b"##FH", &[0, comment], &[0; 16]);
    let header = block(b"##HD", &[whole, history, 0, 0, 0, 0], &[0; 32]);
    blocks.0[64..64 + header.len()].copy_from_slice(&header);
    blocks.0
}

/// Writes a file with one group of these channels and records.
pub fn write(path: &Path, channels: &[Channel], records: &[Vec<u8>]) {
    std::fs::write(path, file(channels, records)).unwrap();
}
