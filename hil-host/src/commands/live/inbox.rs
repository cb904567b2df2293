//! Events of viewers on their way to the operator's side.

use std::sync::Arc;
use std::sync::mpsc::SyncSender;

use dashpot_server::{Handler, ViewerId, WantedRole};
use serde_json::Value;

use super::stop::Stop;

/// Messages that wait for the operator's side.
pub(super) const EVENTS: usize = 256;

/// Something that a viewer does.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Event {
    /// It comes.
    Joined(ViewerId, WantedRole),
    /// It sends a message.
    Message(ViewerId, Value),
    /// It sends something that is no message.
    Unreadable(ViewerId, String),
    /// It leaves.
    Left(ViewerId),
}

/// Takes events from the connections.
pub(super) struct Inbox {
    pub events: SyncSender<Event>,
    pub stop: Arc<Stop>,
}

impl Inbox {
    fn put(&self, event: Event) {
        // At the end of the run nobody reads any more. A full inbox holds up only those who write so much.
        let _is_read = self.events.send(event);
    }

    fn put_message(&self, viewer: ViewerId, message: Value) {
        // An emergency stop does not wait for what others want.
        if message.get("do").and_then(Value::as_str) == Some("stop") {
            self.stop.press();
        }
        self.put(Event::Message(viewer, message));
    }
}

impl Handler for Inbox {
    fn joined(&self, viewer: ViewerId, role: WantedRole) {
        self.put(Event::Joined(viewer, role));
    }

    fn message(&self, viewer: ViewerId, text: &str) {
        match serde_json::from_str(text) {
            Ok(Value::Array(messages)) => {
                for message in messages {
                    self.put_message(viewer, message);
                }
            }
            Ok(message) => self.put_message(viewer, message),
            Err(error) => self.put(Event::Unreadable(viewer, error.to_string())),
        }
    }

    fn left(&self, viewer: ViewerId) {
        self.put(Event::Left(viewer));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::mpsc::sync_channel;

    use dashpot_server::{Handler, ViewerId};
    use serde_json::json;

    use super::{Event, Inbox};

    #[test]
    fn a_stop_acts_before_anybody_reads_it() {
        let (events, read) = sync_channel(8);
        let inbox = Inbox {
            events,
            stop: Arc::default(),
        };
        let viewer = ViewerId(1);
        inbox.message(viewer, r#"{"do": "run", "factor": 1}"#);
        assert!(!inbox.stop.takes());
        inbox.message(viewer, r#"[{"do": "status"}, {"id": 2, "do": "stop"}]"#);
        assert!(inbox.stop.takes());
        assert!(!inbox.stop.takes());
        inbox.message(viewer, "{");
        let events: Vec<Event> = read.try_iter().collect();
        assert_eq!(events.len(), 4);
        assert_eq!(
            events[2],
            Event::Message(viewer, json!({"id": 2, "do": "stop"}))
        );
        assert!(matches!(events[3], Event::Unreadable(..)));
    }
}
