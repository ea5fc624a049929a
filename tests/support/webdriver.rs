//! A browser, driven over `WebDriver` (W3C Recommendation of 2018).
//!
//! Few commands are needed, and a server on this machine needs no TLS. So this file takes the place of a crate that would
//! add an HTTP client to the build of all tests.

use super::http::request;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader};
use std::process::{Child, ChildStdout, Command, Stdio};

/// A browser with one window, which closes with this value.
pub struct Browser {
    driver: Child,
    port: u16,
    session: String,
    /// The driver may print more, and must not find its output closed.
    _output: BufReader<ChildStdout>,
    profile: tempfile::TempDir,
}

impl Browser {
    /// Starts chromium through chromedriver, or returns the reason why there is none.
    pub fn start(width: u32, height: u32) -> Result<Self, String> {
        let driver = Command::new("chromedriver")
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let mut driver = driver.map_err(|error| format!("chromedriver does not start: {error}"))?;
        let stdout = driver.stdout.take().ok_or("chromedriver has no output")?;
        let mut output = BufReader::new(stdout);
        let mut port = None;
        let mut line = String::new();
        while port.is_none() && output.read_line(&mut line).is_ok_and(|read| read > 0) {
            let word = line.split("started successfully on port ").nth(1);
            port = word.and_then(|word| word.trim().trim_end_matches('.').parse().ok());
            line.clear();
        }
        let profile = tempfile::tempdir().map_err(|error| error.to_string())?;
        let mut browser = Self {
            driver,
            port: port.ok_or("chromedriver names no port")?,
            session: String::new(),
            _output: output,
            profile,
        };
        let folder = browser.profile.path().display();
        let arguments = [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            &format!("--user-data-dir={folder}"),
            &format!("--window-size={width},{height}"),
        ]
        .map(String::from);
        let wanted = json!({ "capabilities": { "alwaysMatch": {
            "goog:chromeOptions": { "args": arguments },
            "goog:loggingPrefs": { "browser": "ALL" },
        } } });
        let made = browser.send(("POST", "/session"), &wanted)?;
        browser.session = format!("/session/{}", made["sessionId"].as_str().ok_or("no session")?);
        Ok(browser)
    }

    fn send(&self, (method, path): (&str, &str), body: &Value) -> Result<Value, String> {
        let text = if method == "POST" { body.to_string() } else { String::new() };
        let host = format!("127.0.0.1:{}", self.port);
        let headers = [("Host", host.as_str()), ("Content-Type", "application/json")];
        let (code, answer) = request(self.port, (method, path), &headers, text.as_bytes());
        let answer: Value = serde_json::from_slice(&answer).map_err(|error| error.to_string())?;
        if code == 200 { Ok(answer["value"].clone()) } else { Err(answer.to_string()) }
    }

    fn command(&self, name: &str, body: &Value) -> Value {
        let path = format!("{}/{name}", self.session);
        self.send(("POST", &path), body).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Opens an address.
    pub fn open(&self, address: &str) {
        self.command("url", &json!({ "url": address }));
    }

    /// Runs a script in the page, and returns the value of its `return`.
    pub fn run(&self, script: &str) -> Value {
        self.command("execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// Waits until a script returns a true value, at most a minute. Returns this value.
    pub fn wait(&self, script: &str) -> Value {
        for _ in 0..600 {
            let value = self.run(script);
            if !matches!(value, Value::Null | Value::Bool(false)) {
                return value;
            }
            std::thread::sleep(std::time::Duration::from_millis(100));
        }
        panic!("never true: {script}; {}", self.log());
    }

    /// Sets the size of the window in pixels.
    pub fn resize(&self, width: u32, height: u32) {
        self.command("window/rect", &json!({ "width": width, "height": height }));
    }

    /// Returns the middle of an element that a script returns, in pixels.
    pub fn middle(&self, element: &str) -> [f64; 2] {
        let script = format!(
            "const box = ({element}).getBoundingClientRect(); \
             return [box.x + box.width / 2, box.y + box.height / 2];"
        );
        let found = self.run(&script);
        [0, 1].map(|k| found[k].as_f64().unwrap_or_else(|| panic!("{element}: {found}")))
    }

    /// Presses at a point, moves by a distance in steps of some milliseconds, and lets go.
    pub fn drag(&self, [x, y]: [f64; 2], [across, down]: [f64; 2], steps: u32, pause: u32) {
        let at = |x: f64, y: f64, duration: u32| {
            let (x, y) = (x.round() as i64, y.round() as i64);
            json!({ "type": "pointerMove", "duration": duration, "x": x, "y": y })
        };
        let mut actions = vec![at(x, y, 0), json!({ "type": "pointerDown", "button": 0 })];
        for k in 1..=steps {
            let part = f64::from(k) / f64::from(steps);
            actions.push(at(x + across * part, y + down * part, pause));
        }
        actions.push(json!({ "type": "pointerUp", "button": 0 }));
        let mouse = json!({ "type": "pointer", "id": "mouse", "actions": actions });
        self.command("actions", &json!({ "actions": [mouse] }));
    }

    /// Moves fingers on a touch screen at the same time, each from one point to another.
    pub fn touch(&self, fingers: &[[[f64; 2]; 2]], steps: u32) {
        let one = |(number, [from, to]): (usize, &[[f64; 2]; 2])| {
            let at = |part: f64, duration: u32| {
                let [x, y] = [0, 1].map(|k| (from[k] + part * (to[k] - from[k])).round() as i64);
                json!({ "type": "pointerMove", "duration": duration, "x": x, "y": y })
            };
            let mut actions = vec![at(0.0, 0), json!({ "type": "pointerDown", "button": 0 })];
            actions.extend((1..=steps).map(|k| at(f64::from(k) / f64::from(steps), 30)));
            actions.push(json!({ "type": "pointerUp", "button": 0 }));
            json!({ "type": "pointer", "id": format!("finger {number}"),
                "parameters": { "pointerType": "touch" }, "actions": actions })
        };
        let fingers: Vec<Value> = fingers.iter().enumerate().map(one).collect();
        self.command("actions", &json!({ "actions": fingers }));
    }

    /// Presses keys one after another. `\u{e004}` is Tab, `\u{e007}` Enter, `\u{e012}` to `\u{e015}` are the arrows
    /// left, up, right and down, and `\u{e017}` is Delete.
    pub fn keys(&self, text: &str) {
        let press =
            |key: char| ["keyDown", "keyUp"].map(|kind| json!({ "type": kind, "value": key }));
        let actions: Vec<Value> = text.chars().flat_map(press).collect();
        let keys = json!({ "type": "key", "id": "keys", "actions": actions });
        self.command("actions", &json!({ "actions": [keys] }));
    }

    /// Drops a file with a text or bytes on an element that a script returns.
    pub fn drop_file(&self, element: &str, name: &str, bytes: &[u8]) {
        self.run(&format!(
            "const data = new DataTransfer(); data.items.add(new File([new Uint8Array({bytes:?})], '{name}')); \
             ({element}).dispatchEvent(new DragEvent('drop', {{ dataTransfer: data, bubbles: true, cancelable: true }}));"
        ));
    }

    /// Returns the messages of the page's console.
    pub fn log(&self) -> Value {
        self.command("se/log", &json!({ "type": "browser" }))
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        if !self.session.is_empty() {
            let _ = self.send(("DELETE", &self.session), &Value::Null);
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
