//! The files of the page, which are built into the program.

use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};

macro_rules! assets {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("page/", $name)))),*]
    };
}

/// The files by name.
const FILES: &[(&str, &str)] = assets![
    "api.js",
    "base.css",
    "bezier.js",
    "camera.js",
    "colors.js",
    "contour.js",
    "curves.css",
    "exports.js",
    "findings.js",
    "form.js",
    "forms.css",
    "icon.svg",
    "index.html",
    "laws.js",
    "layout.css",
    "main.js",
    "marks.js",
    "model.js",
    "parts.js",
    "picture.js",
    "pictures.js",
    "planar.js",
    "plane.js",
    "positions.js",
    "sections.js",
    "start.js",
    "starts.js",
    "store.js",
    "tabs.js",
    "text.js",
    "toolbar.js",
    "trajectory.js",
];

/// Returns the response with a file of the page.
pub fn serve(name: &str) -> Response {
    let Some((_, text)) = FILES.iter().find(|(own, _)| *own == name) else {
        return (StatusCode::NOT_FOUND, "there is no such file").into_response();
    };
    let kind = match name.rsplit_once('.') {
        Some((_, "css")) => "text/css; charset=utf-8",
        Some((_, "js")) => "text/javascript; charset=utf-8",
        Some((_, "svg")) => "image/svg+xml",
        _ => "text/html; charset=utf-8",
    };
    ([(CONTENT_TYPE, kind)], *text).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_file_of_the_page_is_built_in_and_names_no_other_site() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/studio/page");
        let on_disk: BTreeSet<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        let built_in: BTreeSet<String> = FILES.iter().map(|(name, _)| (*name).into()).collect();
        assert_eq!(built_in, on_disk);
        for (name, text) in FILES {
            assert!(text.lines().count() <= 400, "{name}");
            // The name of a vocabulary is no address that a browser loads.
            let text = text.replace("http://www.w3.org/2000/svg", "");
            assert!(!text.contains("http://") && !text.contains("https://"), "{name}");
        }
    }
}
