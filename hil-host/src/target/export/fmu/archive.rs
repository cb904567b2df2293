//! The file of an FMU: a zip archive.

use std::io::{Cursor, Write};

use zip::result::ZipResult;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::{Binary, Fmu, Interface};
use crate::target::export::Word;

/// The FMU as bytes, the same for the same content; with a library where there is one.
///
/// # Errors
/// A name of a file that no archive can have.
pub fn archive<T: Word>(fmu: &Fmu<T>, binary: Option<&Binary>) -> ZipResult<Vec<u8>> {
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
    if let Some(Binary {
        platform,
        end,
        content,
    }) = binary
    {
        let name = format!("binaries/{platform}/{}.{end}", fmu.identifier);
        put(&name, content, true)?;
    }
    if fmu.is_loaded {
        for (number, named) in (1..).zip(&fmu.dampers) {
            let name = format!("resources/image_{number}.bin");
            put(&name, &T::image(&named.damper), false)?;
        }
    }
    for (name, text) in fmu.sources() {
        put(&format!("sources/{name}"), text.as_bytes(), false)?;
    }
    if fmu.interface == Interface::Three {
        put(
            "sources/buildDescription.xml",
            fmu.build_description().as_bytes(),
            false,
        )?;
    }
    Ok(zip.finish()?.into_inner())
}
