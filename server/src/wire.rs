//! Bytes of WebSocket messages. A server's are not masked, so they are the same for all viewers.

use tungstenite::protocol::frame::Frame;
use tungstenite::protocol::frame::coding::{Data, OpCode};

/// Writes a message behind `to`.
fn write(frame: Frame, to: &mut Vec<u8>) {
    // Writing to memory does not fail.
    let _written = frame.format(to);
}

/// A text.
pub(crate) fn text(text: &str) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len() + 10);
    let data = text.as_bytes().to_vec();
    write(
        Frame::message(data, OpCode::Data(Data::Text), true),
        &mut bytes,
    );
    bytes
}

/// Binary messages, one behind the other.
pub(crate) fn binaries<'a>(messages: impl Iterator<Item = &'a [u8]>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for message in messages {
        let data = message.to_vec();
        write(
            Frame::message(data, OpCode::Data(Data::Binary), true),
            &mut bytes,
        );
    }
    bytes
}

/// A question whether the viewer is still there.
pub(crate) fn ping() -> Vec<u8> {
    let mut bytes = Vec::new();
    write(Frame::ping(Vec::new()), &mut bytes);
    bytes
}

/// The end.
pub(crate) fn close() -> Vec<u8> {
    let mut bytes = Vec::new();
    write(Frame::close(None), &mut bytes);
    bytes
}
