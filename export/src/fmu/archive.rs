//! FMU file: a zip archive.

use std::io::{Cursor, Write};

use zip::result::ZipResult;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::{Binary, Fmu, Interface};

/// Path (FMI 3.0, section 2.5.1.4) and text of the licence.
const LICENCE: (&str, &str) = (
    "documentation/licenses/license.txt",
    include_str!("../../LICENSE-MIT"),
);

/// Packs the FMU, with its compiled libraries. The same content gives the same bytes.
///
/// # Errors
/// Returns an error if a file name is not valid in an archive.
pub fn archive(fmu: &Fmu, binaries: &[Binary]) -> ZipResult<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    let mut put = |name: &str, content: &[u8], is_program: bool| -> ZipResult<()> {
        let mode = if is_program { 0o755 } else { 0o644 };
        zip.start_file(name, options.unix_permissions(mode))?;
        Ok(zip.write_all(content)?)
    };
    put("modelDescription.xml", fmu.description().as_bytes(), false)?;
    put("documentation/index.html", fmu.page().as_bytes(), false)?;
    put(LICENCE.0, LICENCE.1.as_bytes(), false)?;
    for (name, content) in fmu.icon_files() {
        put(name, &content, false)?;
    }
    for binary in binaries {
        let (folder, extension) = (&binary.folder, binary.extension);
        let name = format!("binaries/{folder}/{}.{extension}", fmu.identifier);
        put(&name, &binary.content, true)?;
    }
    for (name, content) in &fmu.resources {
        put(&format!("resources/{name}"), content, false)?;
    }
    if fmu.has_sources() {
        for (name, text) in &fmu.sources {
            put(&format!("sources/{name}"), text.as_bytes(), false)?;
        }
        if fmu.interface == Interface::Three {
            let build = fmu.build_description();
            put("sources/buildDescription.xml", build.as_bytes(), false)?;
        }
    }
    Ok(zip.finish()?.into_inner())
}
