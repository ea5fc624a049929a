//! The studio in a real browser. Without chromium and chromedriver the tests say that they are skipped.

use crate::support::http::Studio;
use crate::support::webdriver::Browser;
use files::exit::say;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Records the time from each movement to the first picture that shows it.
const WATCH: &str = "
    window.answers = []; window.pictures = [];
    document.addEventListener('edit-answered', (event) => window.answers.push(event.detail));
    document.addEventListener('picture-shown', (event) => window.pictures.push(
        { at: performance.now(), revision: event.detail.revision, step: event.detail.step,
          milliseconds: event.detail.milliseconds, size: event.detail.size, times: event.detail.times }));
    // Turns the camera while the picture is refined.
    window.turn = () => document.getElementById('stage').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight' }));";

/// Starts a browser, or says why a test is skipped.
pub fn browser(width: u32, height: u32) -> Option<Browser> {
    match Browser::start(width, height) {
        Ok(browser) => Some(browser),
        Err(reason) => {
            say(format_args!(
                "SKIPPED: no browser: {reason}; install chromium and chromium-driver"
            ));
            None
        }
    }
}

fn opened(folder: &Path, page: &str, browser: &Browser) -> Studio {
    let studio = Studio::start(folder, &[page]);
    browser.open(&studio.address());
    browser.run(WATCH);
    studio
}

/// A joint of the contour in the middle of the list of handles.
const JOINT: &str = "[...document.querySelectorAll('#contour .handle.anchor')].at(5)";

#[test]
fn a_dragged_handle_changes_the_text_and_the_picture_in_all_windows() {
    let Some(browser) = browser(1280, 900) else { return };
    let folder = tempfile::tempdir().unwrap();
    let studio = opened(folder.path(), "vase", &browser);
    browser.wait("return document.getElementById('stage').dataset.step === 'exact'");
    browser.wait("return document.querySelectorAll('#contour .handle.anchor').length > 6");
    let statement = browser.run("return document.getElementById('statement').textContent");
    assert!(statement.as_str().unwrap().starts_with("Error 0.00"), "{statement}");
    let spec = folder.path().join("vase/curves/vase.json");
    let before = fs::read_to_string(&spec).unwrap();
    browser.run("window.answers = []; window.pictures = []");
    browser.drag(browser.middle(JOINT), [25.0, -10.0], 10, 30);
    browser.wait("return !document.getElementById('undo').disabled");
    let steps = "return window.pictures.map((picture) => picture.step)";
    browser.wait("return window.pictures.some((picture) => picture.step === 'exact')");
    let steps = browser.run(steps);
    assert_eq!(steps[0], "draft", "{steps}");
    // The other window shows the same state.
    let second = self::browser(800, 700).unwrap();
    second.open(&studio.address());
    second.wait("return document.getElementById('changed').textContent === '1 not saved'");
    second.run("document.getElementById('save').click()");
    browser.wait("return document.getElementById('changed').textContent === 'saved'");
    let after = fs::read_to_string(&spec).unwrap();
    let changed = before.lines().zip(after.lines()).filter(|(old, new)| old != new).count();
    assert!((1..=2).contains(&changed), "only the segments of the joint change: {changed}");
    browser.run("document.getElementById('undo').click()");
    browser.wait("return document.getElementById('undo').disabled");
    second.run("document.getElementById('save').click()");
    browser.wait("return document.getElementById('changed').textContent === 'saved'");
    assert_eq!(fs::read_to_string(&spec).unwrap(), before);
    for window in [&browser, &second] {
        assert_eq!(window.log(), Value::Array(Vec::new()));
    }
}

#[test]
fn a_fault_is_shown_at_its_line_and_leaves_with_its_correction() {
    let Some(browser) = browser(1280, 900) else { return };
    let folder = tempfile::tempdir().unwrap();
    let _studio = opened(folder.path(), "vase", &browser);
    browser.wait("return document.getElementById('stage').dataset.step");
    browser.run("document.getElementById('tab-text').click()");
    browser.wait("return document.querySelectorAll('#text .tools button').length === 3");
    let type_into = |from: &str, to: &str| {
        browser.run(&format!(
            "[...document.querySelectorAll('#text .tools button')].find((one) => \
             one.textContent.startsWith('curves/')).click(); const area = document.querySelector('#text textarea'); \
             area.value = area.value.replace('{from}', '{to}'); area.dispatchEvent(new Event('input'));"
        ));
    };
    type_into("\"angle_deg\": 360", "\"angle_deg\": 3600");
    let fault = browser.wait(
        "return document.querySelector('#text .bad') && document.getElementById('fault').textContent",
    );
    assert!(fault.as_str().unwrap().contains("trajectory.rotation.angle_deg"), "{fault}");
    assert_eq!(browser.run("return document.querySelector('#text .bad').textContent"), "21");
    type_into("\"angle_deg\": 3600", "\"angle_deg\": 270");
    browser.wait("return document.getElementById('fault').hidden");
}

#[test]
fn pixels_methods_and_narrow_windows_work() {
    let Some(browser) = browser(1280, 900) else { return };
    let folder = tempfile::tempdir().unwrap();
    let _studio = opened(folder.path(), "glass-sphere", &browser);
    browser.wait("return document.getElementById('stage').dataset.step === 'whole' || document.getElementById('stage').dataset.step === 'exact'");
    browser.run("document.getElementById('inspect').click()");
    browser.drag(browser.middle("document.getElementById('stage')"), [0.0, 0.0], 1, 1);
    let tree = browser.wait("const text = document.getElementById('pixel-text').textContent; return text.length > 5 && text");
    let tree = tree.as_str().unwrap();
    assert!(tree.starts_with("pixel ") && tree.contains("sample"), "{tree}");
    browser.run("const select = document.getElementById('method'); select.value = 'point'; select.dispatchEvent(new Event('change'))");
    browser.wait("return !document.getElementById('divider').hidden");
    for (width, height) in [(390, 844), (700, 900), (1280, 800), (2560, 1440)] {
        browser.resize(width, height);
        let wide = browser.run("return document.documentElement.scrollWidth - window.innerWidth");
        assert!(wide.as_i64().unwrap() <= 0, "the page of {width} pixels is too wide by {wide}");
        let small = browser.run("return document.getElementById('stage').clientWidth");
        assert!(small.as_i64().unwrap() >= 250, "the picture has {small} pixels of {width}");
    }
    // Every control has a name for a screen reader.
    let nameless = browser.run(
        "return [...document.querySelectorAll('button, input, select, textarea, [role=button]')].filter((one) => \
         !one.textContent.trim() && !one.getAttribute('aria-label') && !one.labels?.length && !one.title)\
         .map((one) => one.outerHTML)",
    );
    assert_eq!(nameless, Value::Array(Vec::new()));
}

/// Drags a handle, and reports the latency. Nothing is asserted about times.
#[test]
fn latencies_are_reported() {
    let Some(browser) = browser(1280, 900) else { return };
    for page in ["vase", "klein-bottle", "glass-table"] {
        let folder = tempfile::tempdir().unwrap();
        let _studio = opened(folder.path(), page, &browser);
        browser.wait("return document.getElementById('stage').dataset.step === 'exact'");
        if page == "klein-bottle" {
            browser.run("document.getElementById('tab-trajectory').click()");
        }
        let handles = "#curves [role=tabpanel]:not([hidden]) .handle";
        browser.wait(&format!("return document.querySelectorAll('{handles}').length > 0"));
        let handle = format!(
            "[...document.querySelectorAll('{handles}')].at(document.querySelectorAll('{handles}').length > 5 ? 5 : 0)"
        );
        browser.run("window.answers = []; window.pictures = []");
        browser.drag(browser.middle(&handle), [14.0, -6.0], 40, 45);
        browser.wait("return window.pictures.some((picture) => picture.step === 'exact')");
        let times = browser.run(
            "return window.answers.map(({ asked, revision }) => Math.min(...window.pictures\
             .filter((picture) => picture.revision >= revision).map((picture) => picture.at)) - asked)",
        );
        let mut latencies: Vec<f64> =
            times.as_array().unwrap().iter().filter_map(Value::as_f64).collect();
        latencies.sort_by(f64::total_cmp);
        assert!(!latencies.is_empty());
        let at = |part: f64| latencies[((latencies.len() - 1) as f64 * part).round() as usize];
        let exact = browser
            .run("return window.pictures.find((picture) => picture.step === 'exact').milliseconds");
        let sizes = browser.run("return window.pictures.filter((picture) => picture.step === 'draft').map((picture) => picture.size[0])");
        let sizes: Vec<i64> = sizes.as_array().unwrap().iter().filter_map(Value::as_i64).collect();
        let (least, most) = (sizes.iter().min(), sizes.iter().max());
        let times = browser.run("return window.pictures.filter((picture) => picture.times).map((picture) => picture.times)");
        let mean = |key: &str| {
            let all: Vec<f64> =
                times.as_array().unwrap().iter().filter_map(|one| one[key].as_f64()).collect();
            all.iter().sum::<f64>() / all.len().max(1) as f64
        };
        say(format_args!(
            "studio, {page} at 512 px: first picture after {:.0} ms (median), {:.0} ms (95 %), {} movements, drafts of \
             {least:?} to {most:?} px (meshes {:.0} ms, picture {:.0} ms on average); stated error of 0.01 after {exact} ms",
            at(0.5),
            at(0.95),
            latencies.len(),
            mean("meshes"),
            mean("picture"),
        ));
        // Changes in the middle of the refinement, and the time until work on them starts.
        browser.run("window.pictures = []");
        for pause in [250, 300, 350, 400, 450, 500] {
            browser.run("window.turn()");
            std::thread::sleep(std::time::Duration::from_millis(pause));
        }
        browser.wait("return window.pictures.some((picture) => picture.times)");
        let waited = browser.run("return window.pictures.filter((picture) => picture.times).map((picture) => picture.times.waited)");
        let mut waited: Vec<f64> =
            waited.as_array().unwrap().iter().filter_map(Value::as_f64).collect();
        waited.sort_by(f64::total_cmp);
        say(format_args!(
            "studio, {page}: obsolete work ended after {:.0} ms (median), {:.0} ms (longest of {})",
            waited[waited.len() / 2],
            waited[waited.len() - 1],
            waited.len()
        ));
    }
}
