//! The constants of a damper in C: its numbers, its pieces and the bins that find them.

use std::fmt::Write;

use dashpot_core::Damper;

use super::digest::digest;
use super::number::hexadecimal;
use crate::Word;

/// Scalars of a damper, and two revisions after them, before the pieces.
const SCALARS: usize = 11;
const REVISIONS: usize = 2;

/// The scalar that is half the force limit, which C has whole.
const HALF_FORCE_LIMIT: usize = 7;

/// The scalars that are compared by their bits, which C has as bits: bounds of move, displacement and stretch.
const BOUNDS: [usize; 3] = [0, 9, 10];

/// Words of a piece: three cubics and its knot.
const PIECE: usize = 13;

/// Pieces of a side.
const PIECES: usize = 64;

/// Numbers of a piece in C.
const NUMBERS: usize = 16;

/// Bytes of the constants but for the damper's own numbers.
pub(super) fn bytes<T: Word>(damper: &Damper<T>) -> usize {
    2 * PIECES * NUMBERS * size_of::<T>() + size_of_val(damper.bins())
}

/// What the header says of them.
pub(super) fn declarations<T: Word>(constant: &str, damper: &Damper<T>) -> String {
    let name = constant.to_lowercase();
    format!(
        "/* The damper as built: step with it, or copy it to change the clearance of the copy. */\n\
         extern const {name}_damper {name}_as_built;\n\n\
         /* What {name}_digest(&{name}_as_built) returns where the forces are those of the model in Rust. */\n\
         #define {constant}_DIGEST UINT32_C({:#010x})\n",
        digest(damper)
    )
}

/// The constants themselves, their names beginning with `name`, of the step whose names begin with `prefix`.
pub(super) fn definitions<T: Word>(prefix: &str, name: &str, damper: &Damper<T>) -> String {
    let words = T::words(damper);
    let (scalars, rest) = words.split_at(SCALARS);
    let (revisions, pieces) = rest.split_at(REVISIONS);
    let mut text = format!(
        "\nstatic const {prefix}_piece {name}_pieces[{}] = {{\n",
        2 * PIECES
    );
    for side in pieces.chunks(PIECES * PIECE) {
        let pieces: Vec<&[u64]> = side.chunks(PIECE).collect();
        let knot = |piece: usize| match pieces.get(piece).and_then(|piece| piece.last()) {
            Some(&word) => hexadecimal(T::from_word(word)),
            None => hexadecimal(T::MAX),
        };
        for (place, piece) in pieces.iter().enumerate() {
            let cubics = piece
                .chunks_exact(4)
                .map(|cubic| format!("{{{}}}", list::<T>(cubic)));
            // Writing to a String does not fail.
            let _ = writeln!(
                text,
                "    {{{},\n     {}, {{{}, {}}}, 0}},",
                cubics.collect::<Vec<_>>().join(",\n     "),
                knot(place),
                knot(place + 1),
                knot(place + 2),
            );
        }
    }
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
    let bits = 8 * size_of::<T>();
    for (place, word) in scalars.iter().enumerate() {
        if BOUNDS.contains(&place) {
            let _ = writeln!(text, "    UINT{bits}_C({word:#x}),");
            continue;
        }
        let mut number = T::from_word(*word);
        if place == HALF_FORCE_LIMIT {
            number = number + number;
        }
        let _ = writeln!(text, "    {},", hexadecimal(number));
    }
    for revision in revisions {
        let _ = writeln!(text, "    UINT32_C({revision:#010x}),");
    }
    let _ = write!(text, "    {name}_pieces,\n    {name}_bins\n}};\n");
    text
}

fn list<T: Word>(words: &[u64]) -> String {
    let numbers: Vec<String> = words
        .iter()
        .map(|word| hexadecimal(T::from_word(*word)))
        .collect();
    numbers.join(", ")
}
