//! Requests to a server on this machine, for the studio and for a browser's driver.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A response: its code and its body.
pub type Response = (u16, Vec<u8>);

/// Sends a request to a port of this machine with the given headers, and returns the response.
pub fn request(
    port: u16,
    (method, path): (&str, &str),
    headers: &[(&str, &str)],
    body: &[u8],
) -> Response {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("the server listens");
    stream.set_read_timeout(Some(Duration::from_secs(120))).expect("a time is set");
    let mut head = format!("{method} {path} HTTP/1.1\r\nConnection: close\r\n");
    for (name, value) in headers {
        head += &format!("{name}: {value}\r\n");
    }
    head += &format!("Content-Length: {}\r\n\r\n", body.len());
    stream.write_all(head.as_bytes()).expect("the server reads");
    // A server that refuses a large body closes the connection before it has read all of it.
    let _ = stream.write_all(body);
    let mut reader = BufReader::new(stream);
    let mut line = String::new();
    reader.read_line(&mut line).expect("the server answers");
    let code = line.split(' ').nth(1).and_then(|code| code.parse().ok()).unwrap_or(0);
    let mut length = None;
    loop {
        line.clear();
        reader.read_line(&mut line).expect("the server answers");
        let header = line.trim().to_ascii_lowercase();
        if header.is_empty() {
            break;
        }
        if let Some(value) = header.strip_prefix("content-length:") {
            length = value.trim().parse::<usize>().ok();
        }
    }
    let mut body = vec![0; length.unwrap_or(0)];
    match length {
        Some(_) => reader.read_exact(&mut body).expect("the body is whole"),
        None => {
            let _ = reader.read_to_end(&mut body);
        }
    }
    (code, body)
}

/// The studio as a program of its own, which ends with this value.
pub struct Studio {
    child: Child,
    /// The port of its address.
    pub port: u16,
    /// The path of its address, which ends with a slash.
    pub path: String,
}

impl Studio {
    /// Starts the studio in a folder.
    pub fn start(folder: &Path, arguments: &[&str]) -> Self {
        let program = super::programs().join("pipeline");
        let mut child = Command::new(program)
            .arg("studio")
            .args(arguments)
            .current_dir(folder)
            .stdout(Stdio::piped())
            .spawn()
            .expect("the studio starts");
        let stdout = child.stdout.take().expect("standard output is a pipe");
        let mut address = String::new();
        BufReader::new(stdout).read_line(&mut address).expect("the studio prints its address");
        let address = address.trim();
        let rest = address.strip_prefix("http://127.0.0.1:").expect("a local address");
        let (port, path) = rest.split_once('/').expect("a path");
        Self { child, port: port.parse().expect("a port"), path: format!("/{path}") }
    }

    /// The address of the page.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}{}", self.port, self.path)
    }

    /// Sends a request as the page does.
    pub fn ask(&self, path: &str, body: Option<&serde_json::Value>) -> (u16, serde_json::Value) {
        let host = format!("127.0.0.1:{}", self.port);
        let origin = format!("http://{host}");
        let headers =
            [("Host", host.as_str()), ("Origin", &origin), ("Content-Type", "application/json")];
        let method = if body.is_some() { "POST" } else { "GET" };
        let text = body.map(ToString::to_string).unwrap_or_default();
        let path = format!("{}api/{path}", self.path);
        let (code, body) = request(self.port, (method, &path), &headers, text.as_bytes());
        let value = serde_json::from_slice(&body)
            .unwrap_or_else(|_| String::from_utf8_lossy(&body).into_owned().into());
        (code, value)
    }

    /// Sends a request that succeeds, and returns the answer.
    pub fn told(&self, path: &str, body: &serde_json::Value) -> serde_json::Value {
        let (code, answer) = self.ask(path, Some(body));
        assert_eq!(code, 200, "{path}: {answer}");
        answer
    }

    /// Kills the program at once.
    pub fn kill(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.kill();
    }
}
