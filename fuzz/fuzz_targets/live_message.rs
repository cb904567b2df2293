//! Sends any text to a live run as a message of its page. It is done or refused, and the run goes on: every number of a
//! frame is finite.
#![no_main]

use std::cell::RefCell;
use std::rc::Rc;

use dashpot_live::{Choice, Session};
use libfuzzer_sys::fuzz_target;

/// Bytes before the numbers of a frame.
const HEADER: usize = 48;

thread_local! {
    static SESSION: RefCell<Session> = {
        let tables = Rc::new(|pair: &dashpot_live::WheelOnRail| Ok(pair.tables()?));
        let session = Session::new(Choice::of("straight-180"), Vec::new(), tables);
        RefCell::new(session.expect("the case ships"))
    };
}

fuzz_target!(|text: &str| {
    SESSION.with_borrow_mut(|session| {
        let answers = session.message(text);
        assert_eq!(answers.last().expect("an answer")["type"], "answer");
        session.advance(2).expect("a tick");
        let mut frame = Vec::new();
        session.frame(0, &mut frame);
        for number in frame[HEADER..].chunks_exact(4) {
            let number = f32::from_le_bytes([number[0], number[1], number[2], number[3]]);
            assert!(number.is_finite());
        }
    });
});
