//! Tables kept on disk, found again by the content they were computed from.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::node::{NODE_BYTES, Node};
use super::{Axis, Grid, Tables, TablesError, check_grid, pose};
use crate::contact::geometry::ContactGeometry;
use crate::profile::Profile;

/// Why there are no tables from a cache.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CacheError {
    /// The tables cannot be computed.
    #[error(transparent)]
    Tables(#[from] TablesError),
    /// A file is no such tables.
    #[error("{}: damaged, or tables of another version", .path.display())]
    Damaged {
        /// Path of the file.
        path: PathBuf,
    },
    /// A file or the folder of the cache cannot be read or written.
    #[error("{}: {source}", .path.display())]
    File {
        /// Path of the file or folder.
        path: PathBuf,
        /// What went wrong.
        source: io::Error,
    },
}

/// Begins every file of the cache. The first version did not refuse pairs whose force jumps.
const MAGIC: &[u8; 16] = b"dashpot tables 2";
/// Length of the key and of the checksum that follow it.
const DIGEST: usize = 32;
/// Nodes of a file that are computed anew before it is believed: a method that has changed changes them.
const PROBES: usize = 64;

impl Tables {
    /// The tables of [`Tables::new`], read from `folder` if they have been computed before, else computed and kept there.
    ///
    /// A file is found by the profiles, distances, steel, load and grid it was computed from, whatever their names. A file that is
    /// damaged or was computed by another version is replaced. Files are written whole or not at all, so that several
    /// programs can use one folder.
    ///
    /// # Errors
    /// A grid that [`Tables::new`] refuses; a folder that cannot be read, created or written.
    pub fn cached(
        folder: &Path,
        geometry: ContactGeometry,
        grid: Grid,
    ) -> Result<Self, CacheError> {
        let path = folder.join(Self::file_name(&geometry, &grid));
        let failed = |path: &Path| {
            let path = path.to_owned();
            move |source| CacheError::File { path, source }
        };
        check_grid(&grid)?;
        let key = key(&geometry, &grid);
        match fs::read(&path) {
            Ok(bytes) => {
                if let Some(nodes) = nodes(&bytes, &key, &geometry, &grid) {
                    return Ok(Self::of_nodes(geometry, grid, nodes));
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(failed(&path)(error)),
        }
        let tables = Self::new(geometry, grid)?;
        fs::create_dir_all(folder).map_err(failed(folder))?;
        let write = || -> io::Result<()> {
            let mut file = tempfile::NamedTempFile::new_in(folder)?;
            file.write_all(&file_of(&key, &tables.nodes))?;
            file.persist(&path)?;
            Ok(())
        };
        write().map_err(failed(&path))?;
        Ok(tables)
    }

    /// The tables that [`Tables::cached`] has kept in `folder`, which stays as it is.
    ///
    /// # Errors
    /// A grid that [`Tables::new`] refuses; a file that is not there, cannot be read, is damaged or of another version.
    pub fn kept(folder: &Path, geometry: ContactGeometry, grid: Grid) -> Result<Self, CacheError> {
        check_grid(&grid)?;
        let path = folder.join(Self::file_name(&geometry, &grid));
        let bytes = fs::read(&path).map_err(|source| CacheError::File {
            path: path.clone(),
            source,
        })?;
        match nodes(&bytes, &key(&geometry, &grid), &geometry, &grid) {
            Some(nodes) => Ok(Self::of_nodes(geometry, grid, nodes)),
            None => Err(CacheError::Damaged { path }),
        }
    }

    /// What [`Tables::cached`] calls the file of the tables.
    pub fn file_name(geometry: &ContactGeometry, grid: &Grid) -> String {
        let key = key(geometry, grid);
        let name: String = key.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("{name}.tables")
    }
}

/// What the tables depend on, as a hash.
fn key(geometry: &ContactGeometry, grid: &Grid) -> [u8; DIGEST] {
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
        geometry.nominal_load_n(),
    ]);
    let axis = |axis: &Axis| -> Vec<f64> {
        let cells = axis.cells.map(|cells| cells as f64);
        [&axis.ends[..], &cells].concat()
    };
    for part in [&grid.lateral_m, &grid.roll_rad, &grid.yaw_squared_rad2] {
        add(&axis(part));
    }
    hash.finalize().into()
}

/// The bytes of a file: magic, key, checksum of the nodes, nodes as little-endian numbers.
fn file_of(key: &[u8; DIGEST], nodes: &[Node]) -> Vec<u8> {
    let mut payload = Vec::with_capacity(nodes.len() * NODE_BYTES);
    for node in nodes {
        node.write(&mut payload);
    }
    let checksum: [u8; DIGEST] = Sha256::digest(&payload).into();
    [MAGIC, &key[..], &checksum, &payload].concat()
}

/// The nodes in the bytes of a file; `None` unless it is whole, of this key and of this version's method.
fn nodes(
    bytes: &[u8],
    key: &[u8; DIGEST],
    geometry: &ContactGeometry,
    grid: &Grid,
) -> Option<Vec<Node>> {
    let rest = bytes.strip_prefix(MAGIC)?.strip_prefix(key)?;
    let (checksum, payload) = rest.split_at_checked(DIGEST)?;
    let sum: [u8; DIGEST] = Sha256::digest(payload).into();
    if checksum != sum || payload.len() != grid.nodes() * NODE_BYTES {
        return None;
    }
    let (nodes, _) = payload.as_chunks::<NODE_BYTES>();
    let nodes: Vec<Node> = nodes.iter().map(Node::read).collect();
    let mut scratch = Vec::new();
    let unchanged = (0..PROBES).all(|probe| {
        let index = probe * (nodes.len() - 1) / (PROBES - 1);
        let patches = geometry.patches(&pose(geometry, grid, index), &mut scratch);
        nodes[index] == Node::new(patches)
    });
    unchanged.then_some(nodes)
}
