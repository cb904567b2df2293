//! Headless Chromium showing a page, driven through WebDriver.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use fantoccini::actions::{InputSource, MOUSE_BUTTON_LEFT, MouseActions, PointerAction};
use fantoccini::wd::WebDriverCompatibleCommand;
use fantoccini::{Client, ClientBuilder, Locator};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};
use tempfile::TempDir;
use tokio::runtime::{Builder, Runtime};
use xtask::tools::{CHROMEDRIVER, CHROMIUM, have};

/// Records each text written on a canvas, with its font.
const LETTERING: &str = "window.lettering = [];
    const write = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
        window.lettering.push({ text, size: parseFloat(this.font) });
        write.call(this, text, ...place);
    };";

/// Time after which a page is taken to hang. On busy processors, what takes a second may take minutes.
pub const HANGS: Duration = Duration::from_secs(1200);

/// Browser with its own page.
pub struct Browser {
    runtime: Runtime,
    client: Option<Client>,
    driver: Child,
    folder: TempDir,
}

impl Browser {
    /// Starts a browser; returns `None` with a message if it is not installed.
    pub fn start(skipped: &str) -> Option<Self> {
        Self::tracing(skipped, None)
    }

    /// Starts a browser whose performance log also has its own events of this category.
    pub fn tracing(skipped: &str, category: Option<&str>) -> Option<Self> {
        if !have(&[CHROMIUM, CHROMEDRIVER], skipped) {
            return None;
        }
        let folder = tempfile::tempdir().unwrap();
        let mut driver = Command::new(CHROMEDRIVER.program)
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let said = BufReader::new(driver.stdout.take().unwrap());
        let port = said.lines().find_map(|line| {
            let line = line.unwrap();
            let (_, port) = line.split_once("successfully on port ")?;
            Some(port.trim_end_matches('.').to_owned())
        });
        let arguments = [
            "--headless".into(),
            // Overlay scroll bars, as on a phone, where they take no width.
            "--hide-scrollbars".into(),
            "--no-sandbox".into(),
            "--disable-gpu".into(),
            "--no-first-run".into(),
            "--disable-background-networking".into(),
            "--disable-component-update".into(),
            "--disable-sync".into(),
            format!(
                "--user-data-dir={}",
                folder.path().join("profile").display()
            ),
        ];
        let mut options = json!({ "args": arguments });
        if let Some(category) = category {
            options["perfLoggingPrefs"] = json!({ "traceCategories": category });
        }
        let capabilities = json!({
            "goog:chromeOptions": options,
            "timeouts": { "script": HANGS.as_millis() as u64, "pageLoad": HANGS.as_millis() as u64 },
            "goog:loggingPrefs": { "browser": "ALL", "performance": "ALL" },
        });
        let runtime = Builder::new_current_thread().enable_all().build().unwrap();
        let mut browser = Self {
            runtime,
            client: None,
            driver,
            folder,
        };
        let client = browser.runtime.block_on(
            ClientBuilder::new(HttpConnector::new())
                .capabilities(capabilities.as_object().unwrap().clone())
                .connect(&format!("http://127.0.0.1:{}", port.unwrap())),
        );
        browser.client = Some(client.unwrap());
        browser.tell(
            "Page.addScriptToEvaluateOnNewDocument",
            json!({ "source": LETTERING }),
        );
        Some(browser)
    }

    fn client(&self) -> &Client {
        self.client.as_ref().unwrap()
    }

    /// Opens `page` in a window of `width` pixels, like a phone or a desktop; returns its address.
    pub fn open(&self, page: &str, width: u32) -> String {
        let path = self.folder.path().join("page.html");
        std::fs::write(&path, page).unwrap();
        let address = format!("file://{}", path.display());
        self.visit(&address, width);
        address
    }

    /// Opens the page at an address, this many pixels wide.
    pub fn visit(&self, address: &str, width: u32) {
        self.tell(
            "Emulation.setDeviceMetricsOverride",
            json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500 }),
        );
        self.runtime.block_on(self.client().goto(address)).unwrap();
    }

    /// Runs the body of a function in the page and returns its result.
    pub fn find(&self, body: &str) -> Value {
        let found = self.client().execute(body, Vec::new());
        self.runtime.block_on(found).unwrap()
    }

    /// Runs the body of a function in the page and returns the value that it eventually passes to `done`.
    pub fn find_later(&self, body: &str) -> Value {
        let body = format!("const [done] = arguments; {body}");
        let found = self.client().execute_async(&body, Vec::new());
        self.runtime.block_on(found).unwrap()
    }

    /// Waits until an expression is true in the page; it is evaluated whenever the page is drawn.
    pub fn wait_for(&self, condition: &str) {
        let look = format!(
            "const [done] = arguments;
             const look = () => ({condition}) ? done(true) : requestAnimationFrame(look);
             look();"
        );
        let found = self.client().execute_async(&look, Vec::new());
        let found = self.runtime.block_on(found);
        assert!(found.is_ok(), "never so: {condition}: {found:?}");
    }

    /// Moves the mouse to a relative position in the plot with this index.
    pub fn point(&self, plot: usize, at: [f64; 2]) {
        self.act(plot, &[at]);
    }

    /// Drags over part of a plot.
    pub fn drag(&self, plot: usize, from: [f64; 2], to: [f64; 2]) {
        self.act(plot, &[from, to]);
    }

    /// Double-clicks in the middle of a plot. Each click has its number, because a browser that is not given one takes
    /// two clicks for a double click only within 500 ms, which is too short on a busy machine.
    pub fn double_click(&self, plot: usize) {
        self.act(plot, &[[0.5, 0.5]]);
        let [left, top, width, height] = self.area(plot);
        let (x, y) = (left + 0.5 * width, top + 0.5 * height);
        for count in [1, 2] {
            for kind in ["mousePressed", "mouseReleased"] {
                let event =
                    json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": count });
                self.tell("Input.dispatchMouseEvent", event);
            }
        }
    }

    /// Gives an element the focus and presses keys.
    pub fn press(&self, selector: &str, keys: &str) {
        let pressed = async {
            let element = self.client().find(Locator::Css(selector)).await?;
            element.send_keys(keys).await
        };
        self.runtime.block_on(pressed).unwrap();
    }

    /// Clicks an element.
    pub fn click(&self, selector: &str) {
        let clicked = async {
            let element = self.client().find(Locator::Css(selector)).await?;
            element.click().await
        };
        self.runtime.block_on(clicked).unwrap();
    }

    /// Returns the folder into which the browser saves files.
    pub fn saving(&self) -> PathBuf {
        let folder = self.folder.path().join("saved");
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.to_str().unwrap();
        let allowed = json!({ "behavior": "allow", "downloadPath": path });
        self.tell("Browser.setDownloadBehavior", allowed);
        folder
    }

    /// Moves the mouse to the corner of the window, outside all plots.
    pub fn leave(&self) {
        let (duration, x, y) = (Some(Duration::ZERO), 1.0, 1.0);
        let corner = PointerAction::MoveTo { duration, x, y };
        let mouse = MouseActions::new("mouse".into()).then(corner);
        let acted = self.client().perform_actions(mouse);
        self.runtime.block_on(acted).unwrap();
    }

    /// Scrolls to a plot and returns the place of its curves in the window: left, top, width and height.
    fn area(&self, plot: usize) -> [f64; 4] {
        let area = self.find(&format!(
            "const over = document.querySelectorAll('.u-over')[{plot}];
             over.scrollIntoView({{ block: 'center' }});
             const {{ left, top, width, height }} = over.getBoundingClientRect();
             return [left, top, width, height];"
        ));
        serde_json::from_value(area).unwrap()
    }

    fn act(&self, plot: usize, places: &[[f64; 2]]) {
        let [left, top, width, height] = self.area(plot);
        let to = |[x, y]: [f64; 2]| PointerAction::MoveTo {
            duration: Some(Duration::ZERO),
            x: (left + x * width).round(),
            y: (top + y * height).round(),
        };
        let (button, mut mouse) = (MOUSE_BUTTON_LEFT, MouseActions::new("mouse".into()));
        mouse = mouse.then(to(places[0]));
        if let [_, end] = places {
            let [down, up] = [PointerAction::Down { button }, PointerAction::Up { button }];
            mouse = mouse.then(down).then(to(*end)).then(up);
        }
        let acted = self.client().perform_actions(mouse);
        self.runtime.block_on(acted).unwrap();
    }

    /// Returns the browser's log entries since the last call: `browser` for the console, `performance` for the network.
    pub fn log(&self, kind: &str) -> Vec<Value> {
        let entries = self.issue("se/log", json!({ "type": kind }));
        entries.as_array().unwrap().clone()
    }

    /// Returns the messages of the performance log since the last call.
    pub fn messages(&self) -> Vec<Value> {
        let message_of = |entry: Value| {
            let message: Value = serde_json::from_str(entry["message"].as_str().unwrap()).unwrap();
            message["message"].clone()
        };
        self.log("performance")
            .into_iter()
            .map(message_of)
            .collect()
    }

    /// Returns the addresses requested by the page since the last call, including its own.
    pub fn requests(&self, page: &str) -> Vec<String> {
        let messages = self.messages().into_iter();
        messages
            .filter(|message| message["method"] == "Network.requestWillBeSent")
            .filter(|message| message["params"]["documentURL"] == page)
            .map(|message| message["params"]["request"]["url"].as_str().unwrap().into())
            .collect()
    }

    /// Sends a command of the browser's own protocol.
    pub fn tell(&self, command: &str, parameters: Value) {
        let body = json!({ "cmd": command, "params": parameters });
        self.issue("goog/cdp/execute", body);
    }

    fn issue(&self, path: &'static str, body: Value) -> Value {
        let answer = self.client().issue_cmd(Extension { path, body });
        self.runtime.block_on(answer).unwrap()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        if let Some(client) = self.client.take() {
            let _ = self.runtime.block_on(client.close());
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}

/// Sends a command of this driver that is not in the standard.
#[derive(Debug)]
struct Extension {
    path: &'static str,
    body: Value,
}

impl WebDriverCompatibleCommand for Extension {
    fn endpoint(
        &self,
        base: &url::Url,
        session: Option<&str>,
    ) -> Result<url::Url, url::ParseError> {
        base.join(&format!(
            "session/{}/{}",
            session.unwrap_or_default(),
            self.path
        ))
    }

    fn method_and_body(&self, _: &url::Url) -> (http::Method, Option<String>) {
        (http::Method::POST, Some(self.body.to_string()))
    }
}
