//! The page of the studio by touch, by keys and by dropped files, in a real browser.

use crate::studio_browser::browser;
use crate::support::http::Studio;
use crate::support::webdriver::Browser;
use serde_json::Value;
use std::fs;
use std::net::TcpListener;

/// A square tube.
const SPEC: &str = r#"{
  "format": "tb-sweep", "version": 1, "name": "tube",
  "contour": { "polyline": { "closed": true, "points": [[-1, -1], [1, -1], [1, 1], [-1, 1]] } },
  "trajectory": { "line": [[0, 0, 0], [0, 3, 0]] },
  "mesh": { "rows": 8, "cols": 12 }
}
"#;

/// Waits until the text that is shown has a value at a JSON pointer that passes and stays. Returns this value.
fn value_at(browser: &Browser, pointer: &str, passes: impl Fn(&Value) -> bool) -> Value {
    let mut last = Value::Null;
    for _ in 0..300 {
        let text = browser.run("return document.querySelector('#text textarea').value");
        let file: Value = serde_json::from_str(text.as_str().unwrap()).unwrap_or_default();
        let now = file.pointer(pointer).cloned().unwrap_or_default();
        if passes(&now) && now == last {
            return now;
        }
        last = now;
        std::thread::sleep(std::time::Duration::from_millis(150));
    }
    let fault = browser.run("return document.getElementById('fault').textContent");
    panic!("{pointer} stays {last}; {fault}");
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn handle(id: &str) -> String {
    format!("document.querySelector('#contour [data-handle=\"{id}\"]')")
}

/// Presses the button with this text below an element.
fn press(browser: &Browser, within: &str, text: &str) {
    let script = format!(
        "const found = [...document.querySelectorAll('{within} button')].find((one) => one.textContent === '{text}'); \
         if (!found) return false; found.click(); return true;"
    );
    assert_eq!(browser.run(&script), true, "there is no button {text} in {within}");
}

#[test]
fn curves_are_edited_by_touch_keys_numbers_and_files() {
    let Some(browser) = browser(1280, 900) else { return };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tube.json"), SPEC).unwrap();
    let studio = Studio::start(folder.path(), &["tube.json"]);
    browser.open(&studio.address());
    browser.wait("return document.querySelectorAll('#contour .handle').length === 4");
    let points = "/contour/polyline/points";

    // A finger moves a corner, and its mirror image follows.
    press(&browser, "#contour", "Mirror");
    let [x, y] = browser.middle(&handle("p1"));
    browser.touch(&[[[x, y], [x + 30.0, y]]], 6);
    let moved = value_at(&browser, points, |all| number(&all[1][0]) > 1.01);
    assert_eq!(number(&moved[0][0]), -number(&moved[1][0]), "{moved}");
    assert_eq!(moved[0][1], moved[1][1]);
    assert_eq!([&moved[2], &moved[3]], [&serde_json::json!([1, 1]), &serde_json::json!([-1, 1])]);
    press(&browser, "#contour", "Mirror");

    // Snapping holds a corner to quarters of the grid, or to the coordinates of others.
    press(&browser, "#contour", "Snap");
    browser.drag(browser.middle(&handle("p2")), [17.0, -23.0], 5, 10);
    let snapped = value_at(&browser, &format!("{points}/2"), |p| number(&p[0]) > 1.01);
    let labels = browser.run(
        "return [...document.querySelectorAll('#contour svg text')].filter((one) => one.getAttribute('x') > 4)\
         .map((one) => Number(one.textContent)).sort((a, b) => a - b)",
    );
    let step = (number(&labels[1]) - number(&labels[0])) / 4.0;
    for axis in [0, 1] {
        let (own, other) = (number(&snapped[axis]), number(&moved[1][axis]).abs());
        let steps = own / step;
        assert!((steps - steps.round()).abs() < 1e-6 || own == other, "{snapped}, step {step}");
    }
    press(&browser, "#contour", "Snap");

    // A typed number is exact.
    browser.run(&format!("{}.focus()", handle("p3")));
    browser.run("const x = document.querySelector('#contour [aria-label=\"x of the chosen handle\"]'); x.focus(); x.select()");
    browser.keys("-1.375\u{e007}");
    value_at(&browser, &format!("{points}/3/0"), |x| number(x) == -1.375);

    // Without a pointer: Tab reaches the next corner, arrows move it, and Delete removes it.
    browser.run(&format!("{}.focus()", handle("p0")));
    browser.keys("\u{e004}");
    let focused = browser.run("return document.activeElement.dataset.handle");
    assert_eq!(focused, "p1");
    let before = number(&moved[1][1]);
    browser.keys("\u{e013}");
    value_at(&browser, &format!("{points}/1/1"), |y| number(y) > before);
    browser.wait("return document.activeElement.dataset.handle === 'p1'");
    browser.keys("\u{e017}");
    value_at(&browser, points, |all| all.as_array().is_some_and(|all| all.len() == 3));

    // The first path of a dropped SVG takes the place of the contour; its y points down.
    let svg = br#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C1 0 2 1 2 2L0 2Z"/></svg>"#;
    browser.drop_file("document.getElementById('contour')", "shape.svg", svg);
    let segments = value_at(&browser, "/contour/bezier/segments", Value::is_array);
    let first: Vec<Vec<f64>> = serde_json::from_value(segments[0].clone()).unwrap();
    assert_eq!(first, [[0.0, 0.0], [1.0, 0.0], [2.0, -1.0], [2.0, -2.0]]);
    assert_eq!(segments.as_array().unwrap().len(), 3);

    // Sections: two, then three, and the middle one moves along the trajectory.
    press(&browser, "#contour", "Add section");
    value_at(&browser, "/contour/sections/1/at", |at| number(at) == 1.0);
    browser.wait("return document.querySelector('#contour select:not([hidden]):nth-of-type(2)')?.value === 'section 2 at 1'");
    press(&browser, "#contour", "Add section");
    value_at(&browser, "/contour/sections/1/at", |at| number(at) == 0.5);
    browser.run("document.getElementById('tab-trajectory').click()");
    browser.wait("return document.querySelectorAll('#trajectory .section').length === 12");
    browser.run("document.querySelector('#trajectory [data-handle=\"section-0-1\"]').focus()");
    browser.keys("\u{e014}");
    value_at(&browser, "/contour/sections/1/at", |at| number(at) == 0.51);
    let mark = "[...document.querySelectorAll('#trajectory [data-handle=\"section-0-1\"]')][1]";
    browser.drag(browser.middle(mark), [0.0, 15.0], 5, 20);
    value_at(&browser, "/contour/sections/1/at", |at| number(at) < 0.5);

    // A law gets a key, which is dragged.
    browser.run("document.getElementById('tab-laws').click()");
    press(&browser, "#laws", "Add key");
    value_at(&browser, "/scale/keys", |keys| keys.as_array().is_some_and(|keys| keys.len() == 3));
    browser
        .wait("return document.querySelectorAll('#laws .editor:first-child .handle').length === 3");
    let key = "document.querySelectorAll('#laws .editor:first-child .handle')[1]";
    browser.drag(browser.middle(key), [30.0, 25.0], 5, 20);
    value_at(&browser, "/scale/keys/1", |key| number(&key[0]) > 0.5 && number(&key[1]) < 1.0);
    browser.wait("return document.getElementById('fault').hidden");
    assert_eq!(browser.log(), Value::Array(Vec::new()));
}

/// Returns eye and target of the camera once they pass.
fn camera(browser: &Browser, passes: impl Fn([f64; 3], [f64; 3]) -> bool) -> ([f64; 3], [f64; 3]) {
    let point = |value: &Value| [0, 1, 2].map(|k| number(&value[k]));
    let camera = value_at(browser, "/camera", |camera| {
        camera.is_object() && passes(point(&camera["eye"]), point(&camera["target"]))
    });
    (point(&camera["eye"]), point(&camera["target"]))
}

fn far([a, b]: [[f64; 3]; 2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn the_picture_follows_fingers_and_is_divided() {
    let Some(browser) = browser(1280, 900) else { return };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tube.json"), SPEC).unwrap();
    let studio = Studio::start(folder.path(), &["tube.json"]);
    browser.open(&studio.address());
    browser.wait("return document.getElementById('stage').dataset.step === 'exact'");
    browser.run(
        "[...document.querySelectorAll('#text .tools button')].find((one) => one.title === 'tube-scene.json').click()",
    );
    let (eye, target) = camera(&browser, |_, _| true);
    let [x, y] = browser.middle("document.getElementById('stage')");

    // One finger orbits: the distance stays.
    browser.touch(&[[[x, y], [x + 60.0, y + 10.0]]], 6);
    let (orbited, same) = camera(&browser, |now, _| far([now, eye]) > 0.1);
    assert_eq!(same, target);
    assert!((far([orbited, target]) / far([eye, target]) - 1.0).abs() < 1e-3);
    browser.wait("return !document.getElementById('undo').disabled");

    // Two fingers that part come nearer, and the middle between them stays the target.
    browser.touch(&[[[x - 20.0, y], [x - 60.0, y]], [[x + 20.0, y], [x + 60.0, y]]], 8);
    let (near, _) = camera(&browser, |now, _| far([now, target]) < 0.6 * far([eye, target]));
    assert!(far([near, target]) > 0.2 * far([eye, target]), "three times as near");

    // Two fingers that move together pan.
    browser
        .touch(&[[[x - 30.0, y], [x - 30.0, y + 40.0]], [[x + 30.0, y], [x + 30.0, y + 40.0]]], 8);
    camera(&browser, |_, now| far([now, target]) > 0.05);

    // The divider follows a finger and the keys.
    browser.run("const method = document.getElementById('method'); method.value = 'point'; method.dispatchEvent(new Event('change'))");
    browser.wait("return !document.getElementById('divider').hidden");
    let [at, _] = browser.middle("document.getElementById('divider')");
    browser.touch(&[[[at, y], [at + 90.0, y]]], 5);
    let moved = number(&browser.run("return Number(document.getElementById('divider-at').value)"));
    let wide = number(&browser.run("return document.getElementById('stage').clientWidth"));
    assert!((moved - 500.0 - 90_000.0 / wide).abs() < 5.0, "{moved}");
    browser.run("document.getElementById('divider-at').focus()");
    browser.keys("\u{e014}");
    let clip = browser.run("return document.getElementById('beside').style.clipPath");
    assert_eq!(clip, format!("inset(0px 0px 0px {}%)", (moved + 1.0) / 10.0));

    // A tap prints the intersection tree of the pixel under it.
    browser.run("document.getElementById('inspect').click()");
    browser.touch(&[[[x - 50.0, y], [x - 50.0, y]]], 1);
    let tree = browser.wait("const text = document.getElementById('pixel-text').textContent; return text.length > 5 && text");
    assert!(tree.as_str().unwrap().starts_with("pixel "), "{tree}");
    assert_eq!(browser.log(), Value::Array(Vec::new()));
}

#[test]
fn copies_textures_and_a_killed_program_lose_nothing() {
    let Some(browser) = browser(1280, 900) else { return };
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("tube.json"), SPEC).unwrap();
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port().to_string();
    let mut studio = Studio::start(folder.path(), &["tube.json", "--port", &port]);
    browser.open(&studio.address());
    browser.wait("return document.getElementById('stage').dataset.step === 'exact'");

    // Save as: the copy is opened, and the first file stays.
    browser.run("document.getElementById('save-as').click()");
    browser.wait("return document.getElementById('copy').open");
    browser.keys("copies/tube.json\u{e007}");
    browser.wait("return document.getElementById('file-name').textContent === 'copies/tube.json'");
    assert_eq!(fs::read_to_string(at("copies/tube.json")).unwrap(), SPEC);

    // A picture that is dropped on the rendered one becomes a file and the texture of the surface.
    let mut png = std::io::Cursor::new(Vec::new());
    let checks = image::RgbImage::from_fn(8, 8, |x, y| {
        image::Rgb([if (x + y) % 2 == 0 { 255 } else { 20 }; 3])
    });
    checks.write_to(&mut png, image::ImageFormat::Png).unwrap();
    let png = png.into_inner();
    browser.drop_file("document.getElementById('stage')", "my checks.png", &png);
    browser.run(
        "[...document.querySelectorAll('#text .tools button')].find((one) => one.title.endsWith('-scene.json')).click()",
    );
    let texture = value_at(&browser, "/objects/0/mesh/texture", Value::is_string);
    let image = value_at(&browser, "/textures/my-checks/image", Value::is_string);
    assert_eq!((texture, image), ("my-checks".into(), "my-checks.png".into()));
    assert_eq!(fs::read(at("copies/my-checks.png")).unwrap(), png);
    browser.drop_file("document.getElementById('stage')", "no.png", b"no picture");
    browser.wait("return document.getElementById('notice').textContent.startsWith('no.png: ')");

    // Another program changes a file that has changes here: both texts are shown, and one is chosen.
    browser.run(
        "[...document.querySelectorAll('#text .tools button')].find((one) => one.title === 'copies/tube.json').click()",
    );
    press(&browser, "#contour", "Insert");
    value_at(&browser, "/contour/polyline/points/4", Value::is_array);
    let theirs = SPEC.replace("[0, 3, 0]", "[0, 4, 0]");
    fs::write(at("copies/tube.json"), &theirs).unwrap();
    let shown = browser
        .wait("const pre = document.querySelector('#conflict pre'); return pre && pre.textContent");
    assert_eq!(shown, theirs);
    press(&browser, "#conflict", "Take theirs (can be undone)");
    value_at(&browser, "/trajectory/line/1/1", |y| number(y) == 4.0);
    browser.wait("return document.getElementById('conflict').hidden");

    // The program is killed. The page says so, and returns the texts that are not saved to the next program.
    studio.kill();
    browser.wait("return document.getElementById('notice').textContent.startsWith('The program does not answer')");
    assert_eq!(fs::read_to_string(at("copies/tube.json")).unwrap(), theirs);
    let _studio = Studio::start(folder.path(), &["copies/tube.json", "--port", &port]);
    browser.wait(
        "return document.getElementById('notice').textContent === 'The program answers again.'",
    );
    let saved = || fs::read_to_string(at("copies/tube-scene.json")).unwrap_or_default();
    for _ in 0..300 {
        browser.run("document.getElementById('save').click()");
        std::thread::sleep(std::time::Duration::from_millis(100));
        if saved().contains("\"image\": \"my-checks.png\"") {
            return;
        }
    }
    panic!("the texture is lost: {}", saved());
}

/// Names, roles and focus of every control on all panels.
#[test]
fn every_control_has_a_name_and_is_reached_by_keys() {
    let Some(browser) = browser(1280, 900) else { return };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tube.json"), SPEC).unwrap();
    let studio = Studio::start(folder.path(), &["tube.json"]);
    browser.open(&studio.address());
    browser.wait("return document.getElementById('stage').dataset.step");
    for tab in
        ["contour", "trajectory", "laws", "findings", "spec-form", "scene-form", "text", "export"]
    {
        browser.run(&format!("document.getElementById('tab-{tab}').click()"));
        browser.wait(&format!("return !document.getElementById('{tab}').hidden"));
        browser.run(&format!(
            "for (const one of document.querySelectorAll('#{tab} details')) one.open = true"
        ));
        let faults = browser.run(
            "const shown = (one) => one.checkVisibility(); const faults = [];
             const name = (one) => one.getAttribute('aria-label') || [...(one.labels || [])].map((l) => l.textContent).join('').trim()
                 || document.getElementById(one.getAttribute('aria-labelledby') || '-')?.textContent || one.textContent.trim() || one.title;
             for (const one of document.querySelectorAll('button, input, select, textarea, summary, [tabindex], [role]')) {
                 if (shown(one) && !name(one) && !['group', 'status', 'alert'].includes(one.getAttribute('role'))) faults.push('no name: ' + one.outerHTML.slice(0, 120));
                 if (Number(one.getAttribute('tabindex')) > 0) faults.push('an order of its own: ' + one.outerHTML.slice(0, 120));
             }
             const ids = [...document.querySelectorAll('[id]')].map((one) => one.id);
             ids.filter((id, k) => ids.indexOf(id) !== k).forEach((id) => faults.push('twice: ' + id));
             for (const one of document.querySelectorAll('[aria-controls], [aria-labelledby]')) for (const key of ['aria-controls', 'aria-labelledby']) {
                 const id = one.getAttribute(key); if (id && !document.getElementById(id)) faults.push(key + ' of nothing: ' + id);
             }
             for (const image of document.querySelectorAll('img')) if (!image.alt) faults.push('no alt: ' + image.id);
             return faults;",
        );
        assert_eq!(faults, Value::Array(Vec::new()), "{tab}");
    }
    // Tab goes through the page in the order in which it is read: bar, picture, curves, details.
    browser.run("document.getElementById('home').focus()");
    let mut sections = Vec::new();
    for _ in 0..60 {
        browser.keys("\u{e004}");
        let own = browser.run(
            "const focused = document.activeElement; const ring = getComputedStyle(focused); \
             if (focused !== document.body && !focused.closest('svg') && ring.outlineStyle === 'none') return 'no ring: ' + focused.outerHTML; \
             const own = focused.closest('header, #picture, #curves, #details') || focused; return own.id && own.tagName === 'SECTION' ? own.id : own.tagName",
        );
        let own = own.as_str().unwrap().to_string();
        assert!(!own.starts_with("no ring"), "{own}");
        if sections.last() != Some(&own) {
            sections.push(own);
        }
        if sections.last().is_some_and(|last| last == "details") {
            break;
        }
    }
    assert_eq!(sections, ["HEADER", "picture", "curves", "details"]);
}
