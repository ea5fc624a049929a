//! The section on separate measurements of the modeler and the filters.

use super::super::measured::Table;
use crate::report::plot::{self, Size};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, PreEscaped, html};

pub fn section(tables: &[Table]) -> Markup {
    html! {
        @if !tables.is_empty() {
            section id="alone" {
                p.eyebrow { "By themselves" }
                h2 { "Filters, texture coordinates and meshes" }
                @for table in tables { (one(table)) }
            }
        }
    }
}

/// Returns a data URL that contains an SVG drawing.
fn svg_address(drawing: &str) -> String {
    format!("data:image/svg+xml;base64,{}", STANDARD.encode(drawing))
}

fn one(table: &Table) -> Markup {
    let charts = plot::tables::charts(table);
    html! {
        div.table id=(table.name) {
            h3 { (table.title) }
            p { (table.about) }
            @if let Some(command) = table.command { p.faint { "Made again by " code { (command) } } }
            @if !charts.is_empty() {
                div.multiples {
                    @for chart in &charts {
                        (PreEscaped(chart.inline(Size::Small, &table.title)))
                    }
                }
            } @else if let Some(drawing) = table.drawing {
                img.drawing src=(svg_address(drawing)) alt=(table.title);
            }
            details {
                summary { "The table: " (table.rows.len()) " rows" }
                div.wide {
                    table {
                        thead { tr { @for column in &table.columns { th { (column) } } } }
                        tbody {
                            @for row in &table.rows { tr { @for cell in row { td { (cell) } } } }
                        }
                    }
                }
            }
        }
    }
}
