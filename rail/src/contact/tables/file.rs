//! Tables in a file: whole numbers, predicted from neighbouring nodes, and compressed.

use std::io::{Read, Write};

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use sha2::{Digest, Sha256};

use super::axis::Axis;
use super::build::{axes, shift_axis_of};
use super::record::{FIELDS, Record};
use super::shear::Shear;
use super::{DEPTH_UNIT_M, DEPTHS, LEVELS, Node, Tables};
use crate::contact::geometry::ContactGeometry;
use crate::contact::zones::ZONES;
use crate::profile::Profile;

/// The bytes are damaged, belong to other profiles, or were written by another version.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("damaged, or contact tables of other profiles or of another version")]
pub struct NotTheseTables;

/// First bytes of every file. The number rises when the tables of a pair change.
const MAGIC: &[u8; 16] = b"dashpot tables 6";
/// Length in bytes of the key and of the checksum, which follow the magic number.
const DIGEST: usize = 32;
/// Greatest length of uncompressed tables, bytes.
const MAX_BYTES: u64 = 1 << 26;

impl Tables {
    /// The content of a file: magic number, key, checksum of the rest, and the compressed tables.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        let compressed = encoder
            .write_all(&self.plain())
            .and_then(|()| encoder.finish())
            .unwrap_or_default(); // A vector accepts all bytes.
        let checksum: [u8; DIGEST] = Sha256::digest(&compressed).into();
        [MAGIC, &key(&self.geometry)[..], &checksum, &compressed].concat()
    }

    /// Reads what [`Tables::to_bytes`] wrote: the same tables, bit for bit.
    ///
    /// # Errors
    /// The bytes are damaged, belong to another geometry, or were written by another version.
    pub fn from_bytes(geometry: ContactGeometry, bytes: &[u8]) -> Result<Self, NotTheseTables> {
        let rest = bytes
            .strip_prefix(MAGIC)
            .and_then(|rest| rest.strip_prefix(&key(&geometry)));
        let (checksum, compressed) = rest
            .and_then(|rest| rest.split_at_checked(DIGEST))
            .ok_or(NotTheseTables)?;
        let sum: [u8; DIGEST] = Sha256::digest(compressed).into();
        if checksum != sum {
            return Err(NotTheseTables);
        }
        let mut plain = Vec::new();
        let mut decoder = DeflateDecoder::new(compressed).take(MAX_BYTES);
        decoder
            .read_to_end(&mut plain)
            .map_err(|_| NotTheseTables)?;
        Self::from_plain(geometry, Plain { bytes: &plain }).ok_or(NotTheseTables)
    }

    /// Name of the file for the tables of `geometry`: the hash of everything that they depend on.
    pub fn file_name(geometry: &ContactGeometry) -> String {
        let name: String = key(geometry)
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        format!("{name}.tables")
    }

    /// The uncompressed tables: movements, steps of the shift axis, zones of the nodes, their loaded
    /// zones, depths, and records.
    fn plain(&self) -> Vec<u8> {
        let mut plain = Vec::new();
        write(&mut plain, &self.shear.micrometres());
        let steps = self.axes[0].steps().iter().map(|step| *step as i32);
        write(&mut plain, &[steps.len() as i32]);
        write(&mut plain, &steps.collect::<Vec<_>>());
        let of_nodes =
            |number: &dyn Fn(&Node) -> i32| -> Vec<i32> { self.nodes.iter().map(number).collect() };
        write(
            &mut plain,
            &of_nodes(&|node| (node.start & ZONE_MASK) as i32),
        );
        write(&mut plain, &of_nodes(&|node| node.loaded as i32));
        let stride = self.axes[0].nodes();
        for k in 0..DEPTHS {
            let depths = of_nodes(&|node| (f64::from(node.depths_m[k]) / DEPTH_UNIT_M) as i32);
            write(&mut plain, &residuals(&depths, stride));
        }
        for zone in 0..ZONES {
            let numbers = |level: usize, field: usize| -> Vec<i32> {
                let number = |node: &Node| match node.record(zone) {
                    Some(record) => i32::from(self.records[record][level][field]),
                    None => 0,
                };
                self.nodes.iter().map(number).collect()
            };
            for (field, level) in numbers_of_records() {
                let residuals = residuals(&numbers(level, field), stride);
                let present = self.nodes.iter().zip(residuals);
                let present = present.filter(|(node, _)| node.record(zone).is_some());
                write(
                    &mut plain,
                    &present.map(|(_, residual)| residual).collect::<Vec<_>>(),
                );
            }
        }
        plain
    }

    fn from_plain(geometry: ContactGeometry, mut plain: Plain<'_>) -> Option<Self> {
        let shear = Shear::from_micrometres(*plain.take(2)?.first_chunk()?)?;
        let stride = usize::try_from(*plain.take(1)?.first()?).ok()?;
        let steps = plain
            .take(stride)?
            .iter()
            .map(|step| *step as u32)
            .collect();
        let axes = axes(shift_axis_of(steps)?);
        let count = axes.iter().map(Axis::nodes).product();
        let zones = plain.take(count)?;
        let loaded = plain.take(count)?;
        let mut start = 0;
        let mut nodes: Vec<Node> = zones
            .iter()
            .zip(loaded)
            .map(|(zones, loaded)| {
                let zones = *zones as u32 & ZONE_MASK;
                let node = Node {
                    depths_m: [0.0; DEPTHS],
                    start: start << ZONES | zones,
                    loaded: loaded as u32,
                };
                start += zones.count_ones();
                node
            })
            .collect();
        for k in 0..DEPTHS {
            let depths = restored(plain.take(count)?.into_iter(), count, stride, |_| true)?;
            for (node, depth) in nodes.iter_mut().zip(depths) {
                node.depths_m[k] = (f64::from(depth) * DEPTH_UNIT_M) as f32;
            }
        }
        let mut records = vec![[Record::default(); LEVELS]; start as usize];
        for zone in 0..ZONES {
            let present = nodes.iter().filter(|node| node.record(zone).is_some());
            let present = present.count();
            for (field, level) in numbers_of_records() {
                let residuals = plain.take(present)?.into_iter();
                let is_present = |node: usize| nodes[node].record(zone).is_some();
                let numbers = restored(residuals, count, stride, is_present)?;
                for (node, number) in nodes.iter().zip(numbers) {
                    if let Some(record) = node.record(zone) {
                        records[record][level][field] = number as i16;
                    }
                }
            }
        }
        plain
            .bytes
            .is_empty()
            .then(|| Self::from_parts(geometry, axes, &shear, nodes, records))
    }
}

/// Field and level of each number of a record, in the order of the file.
fn numbers_of_records() -> impl Iterator<Item = (usize, usize)> {
    (0..FIELDS).flat_map(|field| (0..LEVELS).map(move |level| (field, level)))
}

/// Bits of the zones in [`Node::start`].
const ZONE_MASK: u32 = (1 << ZONES) - 1;

/// Prediction of a number from its neighbours at the last shift and at the last roll: the plane through them.
fn predicted(numbers: &[i32], node: usize, stride: usize) -> i32 {
    let back = |steps: usize| {
        let neighbour = node.checked_sub(steps).and_then(|k| numbers.get(k));
        neighbour.copied().unwrap_or(0)
    };
    let plane = back(1).wrapping_add(back(stride));
    plane.wrapping_sub(back(stride + 1))
}

/// Differences between numbers and their predictions.
fn residuals(numbers: &[i32], stride: usize) -> Vec<i32> {
    let number = |node: usize| numbers[node].wrapping_sub(predicted(numbers, node, stride));
    (0..numbers.len()).map(number).collect()
}

/// The numbers that have these residuals at the nodes where they are present; zero at the others.
fn restored(
    mut residuals: impl Iterator<Item = i32>,
    count: usize,
    stride: usize,
    is_present: impl Fn(usize) -> bool,
) -> Option<Vec<i32>> {
    let mut numbers = Vec::with_capacity(count);
    for node in 0..count {
        let number = if is_present(node) {
            predicted(&numbers, node, stride).wrapping_add(residuals.next()?)
        } else {
            0
        };
        numbers.push(number);
    }
    Some(numbers)
}

/// Appends numbers as four planes of bytes, so that the compression finds the many zeros of small numbers.
fn write(bytes: &mut Vec<u8>, numbers: &[i32]) {
    for plane in 0..4 {
        // Alternating signs would otherwise fill the upper planes.
        let zigzag = |number: &i32| ((number << 1) ^ (number >> 31)) as u32;
        bytes.extend(
            numbers
                .iter()
                .map(|number| (zigzag(number) >> (8 * plane)) as u8),
        );
    }
}

/// Uncompressed tables that are still to be read.
struct Plain<'a> {
    bytes: &'a [u8],
}

impl Plain<'_> {
    /// Takes the next `count` numbers.
    fn take(&mut self, count: usize) -> Option<Vec<i32>> {
        let (planes, rest) = self.bytes.split_at_checked(4 * count)?;
        self.bytes = rest;
        let number = |k: usize| {
            let bytes = [0, 1, 2, 3].map(|plane| planes[plane * count + k]);
            let zigzag = u32::from_le_bytes(bytes);
            (zigzag >> 1) as i32 ^ -((zigzag & 1) as i32)
        };
        Some((0..count).map(number).collect())
    }
}

/// Hash of everything that the tables depend on.
fn key(geometry: &ContactGeometry) -> [u8; DIGEST] {
    let mut hash = Sha256::new();
    let mut add = |numbers: &[f64]| {
        hash.update((numbers.len() as u64).to_le_bytes());
        for number in numbers {
            hash.update(number.to_le_bytes());
        }
    };
    let pair = geometry.pair();
    let profile = |profile: &Profile| -> Vec<f64> {
        let numbers = profile.points().iter();
        numbers
            .flat_map(|p| [p.y_m, p.z_m, p.angle_rad, p.curvature_per_m])
            .collect()
    };
    add(&profile(pair.wheel()));
    add(&profile(pair.rail()));
    let installation = pair.installation();
    let steel = geometry.steel();
    add(&[
        installation.wheel_radius_m,
        installation.datum_offset_m(),
        steel.young_modulus_pa,
        steel.poisson_ratio,
    ]);
    hash.finalize().into()
}
