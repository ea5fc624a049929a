//! The section on measurements of other programs.

use super::super::accompanying::{ALL, Accompanying};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use csv::StringRecord;
use maud::{Markup, html};

pub fn section() -> Markup {
    html! {
        section id="alone" {
            p.eyebrow { "Separate measurements" }
            h2 { "Filters, texture coordinates and meshes" }
            @for own in &ALL { (one(own)) }
        }
    }
}

/// Returns a data URL that contains an SVG drawing.
fn svg_address(drawing: &str) -> String {
    format!("data:image/svg+xml;base64,{}", STANDARD.encode(drawing))
}

fn one(own: &Accompanying) -> Markup {
    let mut reader = csv::Reader::from_reader(own.table.as_bytes());
    let columns = reader.headers().cloned().unwrap_or_default();
    let rows: Vec<StringRecord> = reader.records().filter_map(Result::ok).collect();
    html! {
        div.table id=(own.name) {
            h3 { (own.title) }
            p { (own.about) }
            p.faint { "Command: " code { (own.command) } }
            img.drawing src=(svg_address(own.drawing)) alt=(own.title);
            details {
                summary { "The table: " (rows.len()) " rows" }
                div.wide {
                    table {
                        thead { tr { @for column in &columns { th { (column) } } } }
                        tbody {
                            @for row in &rows { tr { @for cell in row { td { (cell) } } } }
                        }
                    }
                }
            }
        }
    }
}
