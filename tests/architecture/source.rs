//! The source tree as text: its files, and their code without comments, string literals and tests.
//!
//! The module does not parse Rust. The module recognizes comments, literals, braces, paths and trees
//! of `use`, which is enough for the rules. Macros could hide code from it.

use std::fs;
use std::path::{Path, PathBuf};

/// Returns the root of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns the text of a file, given by its path from the root.
pub fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Returns all Rust files under a folder, as sorted paths from the root; `""` is the root itself.
pub fn rust_files(folder: &str) -> Vec<String> {
    files(folder, ".rs")
}

/// Returns all files under a folder whose names have this ending, as sorted paths from the root.
pub fn files(folder: &str, ending: &str) -> Vec<String> {
    let mut found = Vec::new();
    let entries = fs::read_dir(root().join(folder)).unwrap_or_else(|e| panic!("{folder}: {e}"));
    for entry in entries {
        let entry = entry.expect("the tree stays as it is while it is read");
        let name = entry.file_name().into_string().expect("names in the tree are text");
        let path = if folder.is_empty() { name.clone() } else { format!("{folder}/{name}") };
        // Skips build products, hidden files, and the pictures of the first command in the README.
        if name.starts_with('.') || ["target", "out"].contains(&path.as_str()) {
            continue;
        }
        if entry.path().is_dir() {
            found.extend(files(&path, ending));
        } else if name.ends_with(ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Returns the code without comments and without the contents of literals. Lines keep their
/// numbers.
pub fn code(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let (kept, length) = if rest.starts_with("//") {
            ("", rest.find('\n').unwrap_or(rest.len()))
        } else if rest.starts_with("/*") {
            ("", block_comment(rest))
        } else if let Some(length) = raw_text(rest).filter(|_| !code.ends_with(is_word)) {
            ("\"\"", length)
        } else if first == '"' {
            ("\"\"", 1 + quoted(&rest[1..], '"'))
        } else if first == '\'' && is_character(&rest[1..]) {
            ("' '", 1 + quoted(&rest[1..], '\''))
        } else {
            (&rest[..first.len_utf8()], first.len_utf8())
        };
        code.push_str(kept);
        if kept != &rest[..length] {
            code.extend(rest[..length].chars().filter(|&c| c == '\n'));
        }
        rest = &rest[length..];
    }
    code
}

/// Returns code (a result of [`code`]) without the items that are compiled for tests only.
pub fn without_tests(code: &str) -> String {
    const MARK: &str = "#[cfg(test)]";
    let mut kept = String::new();
    let mut rest = code;
    while let Some(at) = rest.find(MARK) {
        kept.push_str(&rest[..at]);
        rest = &rest[at + MARK.len()..];
        let mut depth = 0;
        let end = rest.find(|c| {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ => {}
            }
            depth == 0 && (c == ';' || c == '}')
        });
        rest = &rest[end.map_or(rest.len(), |end| end + 1)..];
    }
    kept + rest
}

/// Returns every path in the code that starts with one of `starts`, such as `crate::shape::Mesh`. A
/// tree of `use` gives one path for each leaf.
pub fn paths(code: &str, starts: &[&str]) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for start in starts {
        for (at, _) in code.match_indices(&format!("{start}::")) {
            let before = code[..at].chars().next_back();
            if !before.is_some_and(|c| is_word(c) || c == ':') {
                tree(&code[at..], &mut Vec::new(), &mut found);
            }
        }
    }
    found
}

/// Returns whether `word` occurs in the text as a whole word.
pub fn has_word(text: &str, word: &str) -> bool {
    text.match_indices(word).any(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + word.len()..]);
        !before.ends_with(is_word) && !after.starts_with(is_word)
    })
}

/// Returns the texts in backquotes on a page, outside its fenced blocks.
pub fn spans(page: &str) -> Vec<&str> {
    let outside = page.split("```").step_by(2);
    outside.flat_map(|part| part.split('`').skip(1).step_by(2)).collect()
}

/// Reads one tree of `use` or path at the start of the text and returns the rest of the text.
fn tree<'t>(text: &'t str, prefix: &mut Vec<String>, found: &mut Vec<Vec<String>>) -> &'t str {
    let text = text.trim_start();
    if let Some(mut inner) = text.strip_prefix('{') {
        while !inner.is_empty() && !inner.starts_with('}') {
            inner = tree(inner, &mut prefix.clone(), found);
            // Skips an alias.
            inner = inner.trim_start_matches(|c: char| c.is_whitespace() || is_word(c));
            inner = inner.trim_start_matches(',').trim_start();
        }
        return inner.strip_prefix('}').unwrap_or(inner);
    }
    let length = text.find(|c: char| !is_word(c)).unwrap_or(text.len());
    let (word, rest) = text.split_at(length);
    if !word.is_empty() && word != "self" {
        prefix.push(word.into());
    }
    match rest.strip_prefix("::") {
        Some(rest) if rest.starts_with(|c: char| is_word(c) || c == '{') => {
            tree(rest, prefix, found)
        }
        // A star or the parameters of a type.
        Some(rest) => {
            found.push(prefix.clone());
            &rest[1..]
        }
        None => {
            found.push(prefix.clone());
            // Skips a character that belongs to no path, so that reading continues.
            if word.is_empty() { rest.get(1..).unwrap_or_default() } else { rest }
        }
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Returns the length of a block comment; block comments nest.
fn block_comment(text: &str) -> usize {
    let (mut depth, mut at) = (0, 0);
    while at < text.len() {
        match &text.as_bytes()[at..] {
            [b'/', b'*', ..] => (depth, at) = (depth + 1, at + 2),
            [b'*', b'/', ..] => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return at;
        }
    }
    text.len()
}

/// Returns the length of a raw string literal, if one starts here.
fn raw_text(text: &str) -> Option<usize> {
    let start = text.strip_prefix("br").or_else(|| text.strip_prefix('r'))?;
    let opened = start.trim_start_matches('#').strip_prefix('"')?;
    let signs = &start[..start.len() - opened.len() - 1];
    let end = format!("\"{signs}");
    let before = text.len() - opened.len();
    Some(opened.find(&end).map_or(text.len(), |at| before + at + end.len()))
}

/// Returns the length up to and including the closing quote.
fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        if c == quote && !escaped {
            return at + 1;
        }
        escaped = c == '\\' && !escaped;
    }
    text.len()
}

/// Returns whether the text after a single quote is a character and not a lifetime.
fn is_character(text: &str) -> bool {
    let mut chars = text.chars();
    chars.next() == Some('\\') || chars.next() == Some('\'')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_texts_are_no_code() {
        let text =
            "a // b\n/* c /* d */ e */ f(\"g\\\"h\", r#\"i\"j\"#, 'k', '\\'', &'l m)\nfor\"n\"";
        let found = code(text);
        assert_eq!(found, "a \n f(\"\", \"\", ' ', ' ', &'l m)\nfor\"\"");
        assert_eq!(code("\"a\nb\" c"), "\"\"\n c");
    }

    #[test]
    fn tests_are_cut_out() {
        let text = "a;\n#[cfg(test)]\nmod tests {\n fn b() { c }\n}\nd;\n#[cfg(test)]\nmod e;\nf";
        assert_eq!(without_tests(text), "a;\n\nd;\n\nf");
    }

    #[test]
    fn paths_are_found_in_use_trees_and_in_code() {
        let text = "use crate::{a::B as C, d::{self, e::*}, F};\nlet x: crate::g::H<u8> = \
                    not_crate::i(crate::j::k(1)); use super::super::l::M;";
        let found: Vec<String> =
            paths(text, &["crate", "super"]).iter().map(|path| path.join("::")).collect();
        let expected = ["crate::a::B", "crate::d", "crate::d::e", "crate::F", "crate::g::H"];
        assert_eq!(found[..5], expected);
        assert_eq!(found[5..], ["crate::j::k", "super::super::l::M"]);
    }

    #[test]
    fn words_stand_alone_and_fenced_blocks_have_no_spans() {
        assert!(has_word("fn a_b() {}", "a_b") && !has_word("fn a_b() {}", "a"));
        assert_eq!(spans("`a` b `c`\n```\n`d`\n```\n`e`"), ["a", "c", "e"]);
    }
}
