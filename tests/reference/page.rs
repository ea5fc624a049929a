//! A page of the reference: the sections of a schema as Markdown.

use super::examples::Examples;
use super::prose::{cleaned, linked_cell};
use super::schema::{Key, Schema, Section, text};

/// The longest example that stands in a table. A longer one is only linked.
const LONGEST: usize = 72;

/// Sections in a row of the contents.
const ACROSS: usize = 6;

/// A page before its sections.
pub struct Page<'a> {
    pub title: &'a str,
    /// Markdown below the title.
    pub intro: String,
    /// For each section, Markdown below its table.
    pub about: &'a dyn Fn(&str) -> String,
}

/// Returns the Markdown of a page.
pub fn page(page: &Page<'_>, schema: Schema<'_>, examples: &Examples) -> String {
    let sections = schema.sections();
    let mut out = format!("# {}\n\n{}\n\n", page.title, super::MADE);
    out += &format!("{}\n\n", cleaned(text(schema.0, "description")));
    if !page.intro.is_empty() {
        out += &format!("{}\n\n", page.intro.trim());
    }
    out += "## Contents\n\n";
    let link = |section: &Section<'_>| {
        format!("[{}](#{})", section.name, super::schema::anchor(&section.name))
    };
    out += &format!("|{}\n|{}\n", " |".repeat(ACROSS), "---|".repeat(ACROSS));
    for row in sections.chunks(ACROSS) {
        out += &format!("| {} |\n", row.iter().map(link).collect::<Vec<_>>().join(" | "));
    }
    for section in &sections {
        out += &format!("\n## {}\n\n", section.name);
        if !section.description.is_empty() {
            out += &format!("{}\n\n", cleaned(section.description));
        }
        words(&mut out, section);
        keys(&mut out, section, schema, examples);
        let more = (page.about)(&section.name);
        if !more.is_empty() {
            out += &format!("\n{}\n", more.trim());
        }
    }
    out
}

fn words(out: &mut String, section: &Section<'_>) {
    if section.words.is_empty() {
        return;
    }
    *out += "| value | meaning |\n|---|---|\n";
    for (word, meaning) in &section.words {
        *out += &format!("| `{word}` | {} |\n", linked_cell(meaning));
    }
    if !section.keys.is_empty() {
        *out += "\nAn object has one of these keys instead:\n\n";
    }
}

fn keys(out: &mut String, section: &Section<'_>, schema: Schema<'_>, examples: &Examples) {
    if section.keys.is_empty() {
        return;
    }
    *out += "| key | values | default | meaning |\n|---|---|---|---|\n";
    for key in &section.keys {
        let place = format!("{}.{}", section.name, key.name);
        let values = schema.values(key.schema, &place);
        let mut meaning = linked_cell(meaning(key, schema));
        if let Some(example) = examples.get(&(section.name.clone(), key.name.to_owned())) {
            let file = example.document.rsplit('/').next().unwrap_or_default();
            let shown = if example.text.len() <= LONGEST {
                format!("`\"{}\": {}`", key.name, example.text.replace('|', "\\|"))
            } else {
                format!("in [{file}](../../{})", example.document)
            };
            meaning += &format!(" <br>Example: {shown}");
        }
        *out += &format!("| `{}` | {values} | {} | {meaning} |\n", key.name, default(key));
    }
}

/// Returns what a key means, by its own description or by that of its type.
pub fn meaning<'a>(key: &Key<'a>, schema: Schema<'a>) -> &'a str {
    let own = text(key.schema, "description");
    let of_type = text(schema.resolved(key.schema).0, "description");
    [own, key.choice, of_type].into_iter().find(|text| !text.is_empty()).unwrap_or_default()
}

fn default(key: &Key<'_>) -> String {
    match key.schema.get("default") {
        _ if key.required => "required".into(),
        Some(default) => format!("`{}`", super::examples::spaced(default)),
        None => String::new(),
    }
}
