//! Exports for a browser, which has no files: the runs come as JSON.

use std::cell::RefCell;

use crate::{Results, Runs};

thread_local! {
    static BYTES: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Makes room for the runs and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn input(bytes: usize) -> *mut u8 {
    BYTES.with_borrow_mut(|room| {
        room.clear();
        room.resize(bytes, 0);
        room.as_mut_ptr()
    })
}

/// Computes all results and returns the address of their text.
#[unsafe(no_mangle)]
pub extern "C" fn results() -> *const u8 {
    let runs: Runs = BYTES
        .with_borrow(|bytes| serde_json::from_slice(bytes))
        .expect("runs");
    BYTES.replace(Results::new(&runs).text().into_bytes());
    BYTES.with_borrow(Vec::as_ptr)
}

/// Bytes of the text.
#[unsafe(no_mangle)]
pub extern "C" fn results_len() -> usize {
    BYTES.with_borrow(Vec::len)
}
