//! The words of an SVG path: commands, numbers and flags.

use glam::DVec2;

/// Reads commands, numbers and flags, separated by commas and white space.
pub(super) struct Lexer<'a> {
    pub text: &'a str,
    pub at: usize,
}

impl Lexer<'_> {
    fn skip(&mut self) {
        let rest = &self.text[self.at..];
        let trimmed = rest.trim_start_matches(|c: char| c == ',' || c.is_ascii_whitespace());
        self.at += rest.len() - trimmed.len();
    }

    pub fn finished(&mut self) -> bool {
        self.skip();
        self.at == self.text.len()
    }

    /// Reads the next character if it is a letter.
    pub fn command(&mut self) -> Option<char> {
        self.skip();
        let letter = self.text[self.at..].chars().next().filter(char::is_ascii_alphabetic)?;
        self.at += 1;
        Some(letter)
    }

    pub fn point(&mut self) -> Result<DVec2, String> {
        Ok(DVec2::new(self.number()?, self.number()?))
    }

    /// Reads the longest number that follows; `1.5.5` is two numbers.
    pub fn number(&mut self) -> Result<f64, String> {
        self.skip();
        let bytes = self.text.as_bytes();
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(u8::is_ascii_digit) {
                at += 1;
            }
            at
        };
        let sign = |at: usize| at + usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
        let mut end = digits(sign(self.at));
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let exponent = sign(end + 1);
            if digits(exponent) > exponent {
                end = digits(exponent);
            }
        }
        let number = self.text[self.at..end].parse().map_err(|_| self.expected("a number"))?;
        self.at = end;
        Ok(number)
    }

    pub fn flag(&mut self) -> Result<bool, String> {
        self.skip();
        let flag = match self.text.as_bytes().get(self.at) {
            Some(b'0') => false,
            Some(b'1') => true,
            _ => return Err(self.expected("an arc's flag, 0 or 1")),
        };
        self.at += 1;
        Ok(flag)
    }

    /// Returns whether the next character is this one.
    pub fn is_symbol(&mut self, symbol: char) -> bool {
        self.skip();
        self.text[self.at..].starts_with(symbol)
    }

    pub fn symbol(&mut self, symbol: char) -> Result<(), String> {
        if !self.is_symbol(symbol) {
            return Err(self.expected(&format!("`{symbol}`")));
        }
        self.at += symbol.len_utf8();
        Ok(())
    }

    pub fn expected(&self, what: &str) -> String {
        let position = 1 + self.text[..self.at].chars().count();
        match self.text[self.at..].chars().next() {
            Some(found) => format!("found `{found}` at character {position}, expected {what}"),
            None => format!("found the end at character {position}, expected {what}"),
        }
    }
}
