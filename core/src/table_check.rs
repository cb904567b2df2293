//! CRC-32 of a new table, computed over several parts at the same time: each byte of a CRC-32 waits for the one before.

use crate::real::Real;
use crate::table::{ROWS, Table};

const PARTS: usize = 4;
const ROWS_PER_PART: usize = ROWS / PARTS;

/// The polynomial of the CRC-32 with reversed bits.
const POLYNOMIAL: u32 = 0xedb8_8320;

/// Returns the CRC-32 of a table; see [`Table::check`].
pub(crate) fn of<T: Real>(table: &Table<T>) -> u32 {
    let mut parts = [0; PARTS];
    for row in 0..ROWS_PER_PART {
        for (part, crc) in parts.iter_mut().enumerate() {
            *crc = T::check_row(table, ROWS_PER_PART * part + row, *crc);
        }
    }
    let [first, others @ ..] = parts;
    let whole = others.iter().zip(1..).fold(first, |crc, (part, number)| {
        let rows = ROWS_PER_PART * number..ROWS_PER_PART * (number + 1);
        let bytes: u32 = rows.map(|row| bytes_of_row(table, row)).sum();
        after_zeros(crc, bytes) ^ part
    });
    (PARTS * ROWS_PER_PART..ROWS).fold(whole, |crc, row| T::check_row(table, row, crc))
}

/// Number of bytes of a row: eight bins of two sides, or four numbers of a piece.
fn bytes_of_row<T: Real>(table: &Table<T>, row: usize) -> u32 {
    let bytes_of_numbers = 4 * size_of::<T>();
    let rows_of_pieces = size_of_val(&table.pieces) / bytes_of_numbers;
    if row + rows_of_pieces < ROWS {
        16
    } else {
        bytes_of_numbers as u32
    }
}

/// Continues a CRC-32 over `bytes` zeros, without the inversions of the algorithm: multiplies by x^(8 bytes).
fn after_zeros(crc: u32, mut bytes: u32) -> u32 {
    let (mut product, mut power) = (crc, ONE >> 8);
    while bytes > 0 {
        if bytes % 2 == 1 {
            product = times(product, power);
        }
        power = times(power, power);
        bytes /= 2;
    }
    product
}

/// The polynomial 1; lower bits are higher powers of x.
const ONE: u32 = 1 << 31;

/// Product of two polynomials over the field of two elements, modulo that of the CRC-32.
fn times(a: u32, b: u32) -> u32 {
    let (mut product, mut shifted) = (0, b);
    for bit in (0..32).rev() {
        product ^= shifted & (a >> bit & 1).wrapping_neg();
        shifted = shifted >> 1 ^ POLYNOMIAL & (shifted & 1).wrapping_neg();
    }
    product
}

#[cfg(test)]
mod tests {
    use crate::damper::Damper;
    use crate::real::Real;

    fn assert_is_the_check<T: Real>() {
        let damper: Damper<T> = crate::example::reduced_vertical()
            .build(1e-3)
            .expect("a valid damper");
        assert_eq!(super::of(&damper.table), T::table_check(&damper.table));
    }

    #[test]
    fn parts_together_have_the_check_of_the_whole() {
        assert_is_the_check::<f32>();
        assert_is_the_check::<f64>();
    }
}
