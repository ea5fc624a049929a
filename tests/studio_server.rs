//! The studio as its page and as a stranger meet it.

use crate::support::http::{Studio, request};
use serde_json::json;
use std::fs;

const SPEC: &str = "{\n  \"format\": \"tb-sweep\", \"version\": 1,   \"name\": \"pipe\",\n  \
    \"contour\": {\"circle\": 0.50},\n  \"trajectory\": { \"line\": [[0,0,0], [0,3,0]] },\n  \
    \"mesh\": {\"rows\": 4, \"cols\": 12}\n}\n";

#[test]
fn only_the_page_itself_is_answered() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::start(folder.path(), &[]);
    let host = format!("127.0.0.1:{}", studio.port);
    let own = ("Host", host.as_str());
    let get =
        |path: &str, headers: &[(&str, &str)]| request(studio.port, ("GET", path), headers, b"").0;
    assert_eq!(get(&studio.path, &[own]), 200);
    assert_eq!(get(&format!("{}page/main.js", studio.path), &[own]), 200);
    assert_eq!(get("/", &[own]), 404, "the address without its token");
    assert_eq!(get("/00000000000000000000000000000000/", &[own]), 404);
    assert_eq!(get(&studio.path, &[("Host", "evil.example")]), 403, "DNS that was rebound");
    assert_eq!(get(&studio.path, &[]), 403);
    let post = |headers: &[(&str, &str)], body: &[u8]| {
        request(studio.port, ("POST", &format!("{}api/new", studio.path)), headers, body).0
    };
    let kind = ("Content-Type", "application/json");
    let body = br#"{"name": "bowl"}"#;
    assert_eq!(post(&[own, kind], body), 403, "a request without an origin");
    assert_eq!(post(&[own, kind, ("Origin", "http://evil.example")], body), 403);
    let origin = format!("http://{host}");
    assert_eq!(post(&[own, ("Origin", &origin), ("Content-Type", "text/plain")], body), 415);
    let long = vec![b' '; (8 << 20) + 1];
    assert_eq!(post(&[own, kind, ("Origin", &origin)], &long), 413);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    assert_eq!(post(&[own, kind, ("Origin", &origin)], body), 200);
    assert!(folder.path().join("bowl.json").exists());
}

#[test]
fn the_server_is_on_the_loopback_address_alone() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::start(folder.path(), &[]);
    let table = fs::read_to_string("/proc/net/tcp").unwrap_or_default();
    let port = format!(":{:04X}", studio.port);
    let listening = table.lines().filter_map(|line| line.split_whitespace().nth(1));
    let mut own = listening.filter(|address| address.ends_with(&port));
    assert!(own.all(|address| address.starts_with("0100007F")), "{table}");
}

#[test]
fn files_outside_of_the_folder_are_refused() {
    let whole = tempfile::tempdir().unwrap();
    let folder = whole.path().join("mine");
    fs::create_dir(&folder).unwrap();
    fs::write(whole.path().join("outside.json"), SPEC).unwrap();
    fs::write(folder.join("pipe.json"), SPEC).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(whole.path().join("outside.json"), folder.join("link.json"))
        .unwrap();
    let studio = Studio::start(&folder, &["pipe.json"]);
    for name in ["../outside.json", "/etc/passwd", "link.json", "missing.json"] {
        let (code, answer) = studio.ask("open", Some(&json!({ "name": name })));
        assert_eq!(code, 422, "{name}: {answer}");
    }
    for to in ["../new.json", "new.txt", "pipe.json"] {
        let (code, answer) = studio.ask("save", Some(&json!({ "file": "pipe.json", "to": to })));
        assert_eq!(code, 422, "{to}: {answer}");
    }
    let (code, answer) = studio.ask("export", Some(&json!({ "path": "../pipe.obj" })));
    assert_eq!(code, 422, "{answer}");
    assert_eq!(fs::read_dir(whole.path()).unwrap().count(), 2);
    assert_eq!(fs::read_to_string(whole.path().join("outside.json")).unwrap(), SPEC);
}

#[test]
fn an_edit_changes_one_number_and_can_be_undone_and_saved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipe.json");
    fs::write(&path, SPEC).unwrap();
    let studio = Studio::start(folder.path(), &["pipe.json"]);
    let edit = |radius: f64, gesture: &str| {
        let edits = json!([{ "do": "set", "path": ["contour", "circle"], "value": radius }]);
        studio.told("edit", &json!({ "file": "pipe.json", "edits": edits, "gesture": gesture }));
    };
    let saved = || {
        studio.told("save", &json!({ "file": "pipe.json" }));
        fs::read_to_string(&path).unwrap()
    };
    for radius in [0.6, 0.7, 0.75] {
        edit(radius, "drag");
    }
    assert_eq!(saved(), SPEC.replace("0.50", "0.75"));
    studio.told("step", &json!("undo"));
    assert_eq!(saved(), SPEC, "a gesture is one step");
    studio.told("step", &json!("redo"));
    assert_eq!(saved(), SPEC.replace("0.50", "0.75"));
    // A text that another window changed is not overwritten by an older one.
    let old = json!({ "file": "pipe.json", "text": "{}", "base": SPEC });
    let (code, answer) = studio.ask("text", Some(&old));
    assert_eq!(code, 422, "{answer}");
}

#[test]
fn a_file_that_changed_meanwhile_is_a_conflict_and_a_kill_leaves_files_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipe.json");
    fs::write(&path, SPEC).unwrap();
    let mut studio = Studio::start(folder.path(), &["pipe.json"]);
    let edits = json!([{ "do": "set", "path": ["contour", "circle"], "value": 2 }]);
    studio.told("edit", &json!({ "file": "pipe.json", "edits": edits }));
    let theirs = SPEC.replace("0.50", "0.125");
    fs::write(&path, &theirs).unwrap();
    let (code, answer) = studio.ask("save", Some(&json!({ "file": "pipe.json" })));
    assert_eq!(code, 422);
    assert!(answer["message"].as_str().unwrap().contains("choose which text to keep"), "{answer}");
    assert_eq!(fs::read_to_string(&path).unwrap(), theirs);
    studio.told("settle", &json!({ "file": "pipe.json", "mine": true }));
    studio.told("save", &json!({ "file": "pipe.json" }));
    studio.kill();
    assert_eq!(fs::read_to_string(&path).unwrap(), SPEC.replace("0.50", "2"));
    let left: Vec<_> =
        fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().file_name()).collect();
    assert_eq!(left, ["pipe.json"]);
}
