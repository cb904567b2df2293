//! Exports of the WebAssembly module that the worker of the live page calls (`live/page/js/worker.js`).
//!
//! The worker writes into [`input`], calls a function, and reads from the address that [`output_ptr`] or [`frame`]
//! returns before its next call. There are no imports: the module reads no clock, no file and no random number.

#![warn(missing_docs)]

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use dashpot_live::{Json, Session, WheelOnRail};

/// Everything that the module keeps between two calls.
#[derive(Default)]
struct Module {
    input: Vec<u8>,
    output: String,
    frame: Vec<u8>,
    tables: Rc<RefCell<BTreeMap<String, Vec<u8>>>>,
    session: Option<Session>,
}

thread_local! {
    static MODULE: RefCell<Module> = RefCell::new(Module::default());
}

fn with<T>(action: impl FnOnce(&mut Module) -> T) -> T {
    MODULE.with_borrow_mut(action)
}

/// Makes room for an input of `bytes` and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn input(bytes: usize) -> *mut u8 {
    with(|module| {
        module.input.clear();
        module.input.resize(bytes, 0);
        module.input.as_mut_ptr()
    })
}

/// Takes the input as the content of a file of contact tables; `name_bytes` of it are the file's name.
#[unsafe(no_mangle)]
pub extern "C" fn tables(name_bytes: usize) {
    with(|module| {
        let (name, content) = module.input.split_at(name_bytes.min(module.input.len()));
        let name = String::from_utf8_lossy(name).into_owned();
        module.tables.borrow_mut().insert(name, content.to_vec());
    });
}

/// Takes the input as a message of the page; the output is a list of the messages to it.
#[unsafe(no_mangle)]
pub extern "C" fn message() {
    with(|module| {
        let text = String::from_utf8_lossy(&module.input).into_owned();
        let answers = match &mut module.session {
            Some(session) => session.message(&text),
            None => module.first_message(&text),
        };
        module.output = list(&answers);
    });
}

impl Module {
    /// The first message of a page starts a run.
    fn first_message(&mut self, text: &str) -> Vec<Json> {
        let known = Rc::clone(&self.tables);
        let tables = move |pair: &WheelOnRail| {
            let known = known.borrow();
            match known.get(&pair.tables_file_name()?) {
                Some(bytes) => Ok(pair.tables_from(bytes)?),
                None => Ok(pair.computed()?),
            }
        };
        match Session::first(text, Rc::new(tables)) {
            Ok((session, answers)) => {
                self.session = Some(session);
                answers
            }
            Err(answers) => answers,
        }
    }
}

fn list(answers: &[Json]) -> String {
    let texts: Vec<String> = answers.iter().map(ToString::to_string).collect();
    format!("[{}]", texts.join(","))
}

/// Address of the output.
#[unsafe(no_mangle)]
pub extern "C" fn output_ptr() -> *const u8 {
    with(|module| module.output.as_ptr())
}

/// Bytes of the output.
#[unsafe(no_mangle)]
pub extern "C" fn output_len() -> usize {
    with(|module| module.output.len())
}

/// Simulates up to `ticks` ticks and returns their number.
#[unsafe(no_mangle)]
pub extern "C" fn advance(ticks: u32) -> u32 {
    with(|module| {
        let session = module.session.as_mut();
        // An error stops the run; the next status tells why.
        session.map_or(0, |session| session.advance(ticks).unwrap_or(0))
    })
}

/// Number of vehicles.
#[unsafe(no_mangle)]
pub extern "C" fn runs() -> u32 {
    with(|module| module.session.as_ref().map_or(0, Session::runs))
}

/// Writes a frame of a vehicle and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn frame(run: u32) -> *const u8 {
    with(|module| {
        module.frame.clear();
        if let Some(session) = &mut module.session {
            session.frame(run, &mut module.frame);
        }
        module.frame.as_ptr()
    })
}

/// Bytes of the frame.
#[unsafe(no_mangle)]
pub extern "C" fn frame_len() -> usize {
    with(|module| module.frame.len())
}
