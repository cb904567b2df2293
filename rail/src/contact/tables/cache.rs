//! Cache of tables on disk, keyed by a hash of the inputs.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::node::{NODE_BYTES, Node};
use super::{Axis, Grid, Tables, TablesError, check_grid, pose};
use crate::contact::geometry::ContactGeometry;
use crate::profile::Profile;

/// Errors from reading or writing cached tables.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CacheError {
    /// The tables cannot be computed.
    #[error(transparent)]
    Tables(#[from] TablesError),
    /// The file is damaged, belongs to other inputs or was written by another version.
    #[error("{}: damaged, or tables of another version", .path.display())]
    Damaged {
        /// Path of the file.
        path: PathBuf,
    },
    /// A file or the cache folder cannot be read or written.
    #[error("{}: {source}", .path.display())]
    File {
        /// Path of the file or folder.
        path: PathBuf,
        /// The underlying error.
        source: io::Error,
    },
}

/// First bytes of every file. Version 1 did not reject profiles whose contact force jumps.
const MAGIC: &[u8; 16] = b"dashpot tables 2";
/// Length in bytes of the key and of the checksum, which follow the magic number.
const DIGEST: usize = 32;
/// Number of nodes that are recomputed to verify a file, because a changed method gives different nodes.
const PROBES: usize = 64;
/// Maximum number of temporary names that are tried.
const MAX_ATTEMPTS: u32 = 1000;

impl Tables {
    /// Returns the tables of [`Tables::new`]: reads them from `folder` if they were computed before, else computes and
    /// stores them there.
    ///
    /// A file is identified by its profiles, distances, steel, load and grid; names do not matter. A file that is
    /// damaged or was written by another version is replaced. Files are written atomically, so several programs can
    /// share a folder.
    ///
    /// # Errors
    /// [`Tables::new`] rejects the inputs; the folder cannot be created, read or written.
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
                    return Ok(Self::from_nodes(geometry, grid, nodes));
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(failed(&path)(error)),
        }
        let tables = Self::new(geometry, grid)?;
        fs::create_dir_all(folder).map_err(failed(folder))?;
        write_whole(&path, &to_bytes(&key, &tables.nodes)).map_err(failed(&path))?;
        Ok(tables)
    }

    /// Reads tables that [`Tables::cached`] stored in `folder`, without writing anything.
    ///
    /// # Errors
    /// [`Tables::new`] would reject the grid; the file is missing, unreadable, damaged or from another version.
    pub fn kept(folder: &Path, geometry: ContactGeometry, grid: Grid) -> Result<Self, CacheError> {
        check_grid(&grid)?;
        let path = folder.join(Self::file_name(&geometry, &grid));
        let bytes = fs::read(&path).map_err(|source| CacheError::File {
            path: path.clone(),
            source,
        })?;
        match nodes(&bytes, &key(&geometry, &grid), &geometry, &grid) {
            Some(nodes) => Ok(Self::from_nodes(geometry, grid, nodes)),
            None => Err(CacheError::Damaged { path }),
        }
    }

    /// Name of the file in which [`Tables::cached`] stores the tables.
    pub fn file_name(geometry: &ContactGeometry, grid: &Grid) -> String {
        let key = key(geometry, grid);
        let name: String = key.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("{name}.tables")
    }
}

/// Hash of everything that the tables depend on.
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

/// Content of a file: magic number, key, checksum of the nodes, nodes as little-endian numbers.
fn to_bytes(key: &[u8; DIGEST], nodes: &[Node]) -> Vec<u8> {
    let mut payload = Vec::with_capacity(nodes.len() * NODE_BYTES);
    for node in nodes {
        node.write(&mut payload);
    }
    let checksum: [u8; DIGEST] = Sha256::digest(&payload).into();
    [MAGIC, &key[..], &checksum, &payload].concat()
}

/// Writes a file under a temporary name in the same folder and renames it.
fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A name that exists belongs to another process, possibly on another machine, or was left by one that crashed.
    let mut attempt = 0_u32;
    let (temporary, mut file) = loop {
        let temporary = path.with_extension(format!("{}-{attempt}.part", std::process::id()));
        match File::create_new(&temporary) {
            Ok(file) => break (temporary, file),
            Err(error)
                if error.kind() == io::ErrorKind::AlreadyExists && attempt < MAX_ATTEMPTS =>
            {
                attempt += 1;
            }
            Err(error) => return Err(error),
        }
    };
    let written = file.write_all(bytes);
    drop(file);
    let written = written.and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        // The write error is reported; an error of the removal is ignored.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// Returns the nodes in a file; `None` if it is incomplete, has another key or was computed by another method.
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
