//! The page's own files, in the order in which a browser reads them.

/// Content of the page.
pub(crate) const BODY: &str = include_str!("../files/page.html");

/// Style sheet.
pub(crate) const STYLE: &str = include_str!("../files/live.css");

/// Script of the worker that runs the engine.
pub(crate) const WORKER: &str = include_str!("../files/worker.js");

/// Scripts; the last starts the page.
pub(crate) const SCRIPTS: [&str; 32] = [
    include_str!("../files/js/words.js"),
    include_str!("../files/js/sources.js"),
    include_str!("../files/js/frame.js"),
    include_str!("../files/js/inbox.js"),
    include_str!("../files/js/source.js"),
    include_str!("../files/js/paint.js"),
    include_str!("../files/js/pick.js"),
    include_str!("../files/js/vehicle.js"),
    include_str!("../files/js/damper.js"),
    include_str!("../files/js/side.js"),
    include_str!("../files/js/above.js"),
    include_str!("../files/js/behind.js"),
    include_str!("../files/js/contact.js"),
    include_str!("../files/js/curves.js"),
    include_str!("../files/js/panels.js"),
    include_str!("../files/js/loops.js"),
    include_str!("../files/js/slots.js"),
    include_str!("../files/js/bars.js"),
    include_str!("../files/js/row.js"),
    include_str!("../files/js/verdict.js"),
    include_str!("../files/js/target.js"),
    include_str!("../files/js/replay.js"),
    include_str!("../files/js/controls.js"),
    include_str!("../files/js/tries.js"),
    include_str!("../files/js/quantity.js"),
    include_str!("../files/js/dampers.js"),
    include_str!("../files/js/setting.js"),
    include_str!("../files/js/files.js"),
    include_str!("../files/js/keys.js"),
    include_str!("../files/js/case.js"),
    include_str!("../files/js/choices.js"),
    include_str!("../files/js/main.js"),
];
