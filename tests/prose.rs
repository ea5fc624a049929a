//! Checks the mechanical rules of plain English in the Markdown of the project and in doc comments.

use crate::architecture::source::{files, read};

/// Nouns that hide the exact noun of the field. Compounds such as "halfway" and "two-way" are allowed.
const VAGUE: [&str; 4] = ["way", "ways", "thing", "things"];

/// Docs without content: the whole text is one pronoun.
const PRONOUNS: [&str; 8] = ["it", "its", "they", "this", "that", "these", "those", "the same"];

/// Beginnings of noun clauses, which are no sentences: "Whether the mesh is closed."
const CLAUSES: [&str; 3] = ["What ", "Which ", "Whether "];

/// Most words of a sentence. The style asks for 25; enumerations need more.
const LONGEST: usize = 40;

#[test]
fn markdown_is_plain() {
    let found = faults_of(&files("", ".md"));
    assert!(found.is_empty(), "{found}");
}

#[test]
fn doc_comments_are_plain() {
    let found = faults_of(&files("", ".rs"));
    assert!(found.is_empty(), "{found}");
}

/// The faults of Markdown pages, and of the doc comments of Rust files: one line each.
fn faults_of(files: &[String]) -> String {
    let mut found = String::new();
    for path in files {
        let text = read(path);
        let text = if path.ends_with(".rs") { doc_comments(&text) } else { text };
        for (line, paragraph) in paragraphs(&text) {
            for fault in faults(&paragraph) {
                found += &format!("{path}:{line}: {fault}\n");
            }
        }
    }
    found
}

/// The doc comments of a Rust file, with an empty line for each line of code.
fn doc_comments(source: &str) -> String {
    let doc = |line: &str| {
        let line = line.trim_start();
        let text = line.strip_prefix("///").or_else(|| line.strip_prefix("//!")).unwrap_or("");
        text.strip_prefix(' ').unwrap_or(text).to_owned() + "\n"
    };
    source.lines().map(doc).collect()
}

/// Paragraphs, list items and table cells with the number of their first line, from 1. Code, link
/// targets and headings are omitted.
fn paragraphs(doc: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let (mut open, mut fenced) = (false, false);
    for (number, line) in (1..).zip(doc.lines()) {
        let text = line.trim();
        let is_fence = text.starts_with("```");
        fenced ^= is_fence;
        let is_item = text.starts_with("- ") || text.starts_with("[^");
        let is_code = fenced || is_fence || (!open && line.starts_with("    ") && !is_item);
        if is_code || text.is_empty() || text.starts_with('#') {
            open = false;
        } else if let Some(row) = text.strip_prefix('|') {
            found.extend(row.split('|').map(|cell| (number, cell.trim().into())));
            open = false;
        } else if open && !is_item {
            let (_, paragraph) = found.last_mut().expect("a paragraph is open");
            *paragraph = format!("{paragraph} {text}");
        } else {
            found.push((number, text.trim_start_matches("- ").into()));
            open = true;
        }
    }
    found.into_iter().map(|(number, text)| (number, without_code(&text))).collect()
}

/// The text with code spans as one word each, and without the targets of links.
fn without_code(text: &str) -> String {
    let parts = text.split('`').enumerate();
    let text: String = parts.map(|(at, part)| if at % 2 == 0 { part } else { "code" }).collect();
    let mut links = text.split("](");
    let first = links.next().unwrap_or_default().to_owned();
    links.fold(first, |text, link| text + "]" + link.split_once(')').map_or("", |(_, rest)| rest))
}

/// The faults of a paragraph.
fn faults(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let bare = text.trim_matches(|c: char| !c.is_alphanumeric()).to_lowercase();
    if PRONOUNS.contains(&bare.as_str()) {
        found.push(format!("a pronoun alone: {text}"));
    }
    let is_end = |word: &&str| word.trim_end_matches(['*', ')', '"']).ends_with(['.', '!', '?']);
    let words: Vec<&str> = text.split_whitespace().collect();
    for (at, sentence) in words.split_inclusive(is_end).enumerate() {
        let count = sentence.iter().filter(|word| word.contains(char::is_alphanumeric)).count();
        let sentence = sentence.join(" ");
        let is_clause = CLAUSES.iter().any(|clause| sentence.starts_with(clause));
        if at == 0 && is_clause && !sentence.ends_with('?') {
            found.push(format!("a noun clause alone: {sentence}"));
        }
        if count > LONGEST {
            found.push(format!("a sentence of {count} words: {sentence}"));
        }
    }
    // A word with a hyphen is another word: "two-way".
    let is_part = |c: char| c.is_alphanumeric() || c == '-';
    for word in text.split(|c| !is_part(c)).filter(|w| VAGUE.contains(&w.to_lowercase().as_str())) {
        found.push(format!("{word}: {text}"));
    }
    found
}

#[test]
fn faults_are_found_and_plain_text_has_none() {
    for bad in ["They.", "Whether it is closed.", "The way back.", "Things", &"word ".repeat(41)] {
        assert_eq!(faults(bad).len(), 1, "{bad}");
    }
    for good in ["A two-way switch.", "Halfway.", "What is a ray?", &"a. ".repeat(41)] {
        assert_eq!(faults(good), [""; 0], "{good}");
    }
    let source = ["/// A [way](way.md)", "/// `way`", "// way", "//! | It | no way |"].join("\n");
    let found = paragraphs(&doc_comments(&source));
    let expected = [(1, "A [way] code"), (4, "It"), (4, "no way"), (4, "")];
    assert_eq!(found, expected.map(|(line, text)| (line, text.to_owned())));
    assert!(paragraphs("```\nway\n```\n# way\n\n    way").is_empty());
}
