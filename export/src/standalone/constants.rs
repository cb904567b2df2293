//! Constants of a damper in C: scalars, pieces of its table, and the bins for finding a piece.

use std::fmt::Write;

use dashpot_core::Damper;

use super::digest::digest;
use super::number::hexadecimal;
use crate::Word;

/// A damper's words are its scalars, then two revisions (identifiers of its constants), then its pieces.
const SCALARS: usize = 11;
const REVISIONS: usize = 2;

/// Index of the scalar that is half the force limit; C stores the whole limit.
const HALF_FORCE_LIMIT: usize = 7;

/// Indices of the scalars that C compares and stores as bits: the bounds of move, displacement and stretch.
const BIT_BOUNDS: [usize; 3] = [0, 9, 10];

/// Words per piece: three cubics and the knot.
const PIECE_WORDS: usize = 13;

/// Pieces per side (extension, compression).
const PIECES: usize = 64;

/// Pieces of zeros after those of both sides. With them every value of a bin, and the piece after it, is within the
/// table.
const SPARE_PIECES: usize = 2;

/// Rows per piece in C: the cubics, and the knots.
const PIECE_ROWS: usize = 4;

/// Numbers per row in C.
const ROW_NUMBERS: usize = 4;

/// Rows in C.
const ROWS: usize = PIECE_ROWS * (2 * PIECES + SPARE_PIECES);

/// Size of the table in bytes, without the damper's scalars.
pub(super) fn bytes<T: Word>(damper: &Damper<T>) -> usize {
    ROWS * ROW_NUMBERS * size_of::<T>() + size_of_val(damper.bins())
}

/// Returns the declarations for the header.
pub(super) fn declarations<T: Word>(constant: &str, damper: &Damper<T>) -> String {
    let name = constant.to_lowercase();
    format!(
        "/* The damper as built: step with it, or copy it to change the clearance of the copy. */\n\
         extern const {name}_damper {name}_as_built;\n\n\
         /* Value of {name}_digest(&{name}_as_built) if the forces equal those of the Rust model. */\n\
         #define {constant}_DIGEST {:#010x}U\n",
        digest(damper)
    )
}

/// Returns the definitions. Their names start with `name`; the names of the step that uses them start with `prefix`.
pub(super) fn definitions<T: Word>(prefix: &str, name: &str, damper: &Damper<T>) -> String {
    let words = T::words(damper);
    let (scalars, rest) = words.split_at(SCALARS);
    let (revisions, pieces) = rest.split_at(REVISIONS);
    let zero = hexadecimal(T::ZERO);
    let mut text = format!("\nstatic const {prefix}_row {name}_rows[{ROWS}] = {{\n",);
    for side in pieces.chunks(PIECES * PIECE_WORDS) {
        let pieces: Vec<&[u64]> = side.chunks(PIECE_WORDS).collect();
        let knot = |piece: usize| match pieces.get(piece).and_then(|piece| piece.last()) {
            Some(&word) => hexadecimal(T::from_word(word)),
            None => hexadecimal(T::MAX),
        };
        for (index, piece) in pieces.iter().enumerate() {
            let cubics = piece
                .chunks_exact(ROW_NUMBERS)
                .map(|cubic| format!("{{{{{}}}}}", list::<T>(cubic)));
            // Writing to a String does not fail.
            let _ = writeln!(
                text,
                "    {},\n    {{{{{}, {}, {zero}, {zero}}}}},",
                cubics.collect::<Vec<_>>().join(",\n    "),
                knot(index),
                knot(index + 1),
            );
        }
    }
    let zeros =
        vec![format!("    {{{{{zero}, {zero}, {zero}, {zero}}}}}"); PIECE_ROWS * SPARE_PIECES];
    let _ = writeln!(text, "{}", zeros.join(",\n"));
    let bins = damper.bins();
    let _ = write!(
        text,
        "}};\n\nstatic const uint8_t {name}_bins[{}][2] = {{\n",
        bins.len()
    );
    for row in bins.chunks(12) {
        let row: Vec<String> = row
            .iter()
            .map(|[extension, compression]| format!("{{{extension}, {compression}}}"))
            .collect();
        let _ = writeln!(text, "    {},", row.join(", "));
    }
    let _ = write!(text, "}};\n\nconst {prefix}_damper {name}_as_built = {{\n");
    for (index, word) in scalars.iter().enumerate() {
        if BIT_BOUNDS.contains(&index) {
            let _ = writeln!(text, "    {word:#x}U,");
            continue;
        }
        let mut number = T::from_word(*word);
        if index == HALF_FORCE_LIMIT {
            number = number + number;
        }
        let _ = writeln!(text, "    {},", hexadecimal(number));
    }
    for revision in revisions {
        let _ = writeln!(text, "    {revision:#010x}U,");
    }
    let _ = write!(text, "    {name}_rows,\n    {name}_bins\n}};\n");
    text
}

fn list<T: Word>(words: &[u64]) -> String {
    let numbers: Vec<String> = words
        .iter()
        .map(|word| hexadecimal(T::from_word(*word)))
        .collect();
    numbers.join(", ")
}
