//! Doc comments as Markdown of a page.

/// Returns a text without links of Rust documentation: `[`Wall`](crate::Wall)` becomes `Wall` in code.
pub fn cleaned(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find('[') {
        let (before, from) = rest.split_at(start);
        out += before;
        let Some(end) = from.find(']') else {
            rest = from;
            break;
        };
        let (inner, after) = (&from[1..end], &from[end + 1..]);
        let code = inner.len() > 2 && inner.starts_with('`') && inner.ends_with('`');
        let target = after.strip_prefix('(').and_then(|after| after.split_once(')'));
        match target {
            Some((target, after)) if code || target.contains("::") => {
                out += inner;
                rest = after;
            }
            None if code => {
                out += inner;
                rest = after;
            }
            _ => {
                out += &from[..=end];
                rest = after;
            }
        }
    }
    out + rest
}

/// Returns a description as one cell of a table.
pub fn linked_cell(text: &str) -> String {
    cleaned(text).split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

/// Returns the documentation at the start of a Rust file. Headings are two levels deeper.
pub fn documentation(source: &str) -> String {
    let lines = source.lines().map_while(|line| line.strip_prefix("//!"));
    let mut fenced = false;
    let mut out = String::new();
    for line in lines {
        let line = line.strip_prefix(' ').unwrap_or(line);
        fenced ^= line.starts_with("```");
        if !fenced && line.starts_with('#') {
            out += "##";
        }
        let line = if fenced { line.to_owned() } else { cleaned(line) };
        out += &format!("{line}\n");
    }
    out.trim().to_owned()
}

/// Returns the documentation without its first paragraph, which only says what the file holds.
pub fn beyond_the_first(source: &str) -> String {
    let whole = documentation(source);
    whole.split_once("\n\n").map_or(String::new(), |(_, rest)| rest.to_owned())
}
