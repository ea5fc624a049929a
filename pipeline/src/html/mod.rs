//! Writes self-contained HTML pages: styles and pictures are inside, without other files or the
//! network.
//!
//! Pages follow the reader's choice of light or dark, and fit both a telephone and a desktop screen.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use files::words::printed;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("style.css");

/// Returns a whole page with a title and a body.
#[must_use]
pub fn page(title: &str, body: &Markup) -> String {
    styled_page(title, "", body)
}

/// Returns a whole page whose `style` rules follow those that all pages have.
#[must_use]
pub fn styled_page(title: &str, style: &str, body: &Markup) -> String {
    let text = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(style)) }
            }
            body { (body) }
        }
    }
    .into_string();
    // Titles and texts of jobs come from strangers. Such texts may hold characters that change the
    // writing direction of the text after them.
    printed(&text).into_owned()
}

/// Returns a data URL that contains a PNG file.
#[must_use]
pub fn png_address(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_stands_alone_and_texts_are_escaped() {
        let body = html! { p { "a < b & c" } img src=(png_address(b"\x89PNG")) alt=""; };
        let text = page("<title>", &body);
        assert!(text.starts_with("<!DOCTYPE html>"));
        assert!(text.contains("a &lt; b &amp; c") && text.contains("<title>&lt;title&gt;</title>"));
        assert!(text.contains("data:image/png;base64,iVBORw=="));
        for outside in ["http:", "https:", "<script", "<link", "@import", "url("] {
            assert!(!text.contains(outside), "{outside}");
        }
    }
}
