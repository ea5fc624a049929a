//! The mesh as an OBJ file.
//!
//! ```text
//! # topobook triangulate OBJ 1        ours; the last line must be there too
//! o vase                              one object
//! usemtl tex2_surf0                   texture id 2, surface id 0: a scene binds both
//! v 0.5 0 -1                          a row's new positions,
//! vn 1 0 0                            normals
//! vt 0.25 0                           and picture coordinates,
//! f 1/1/1 2/2/2 4/4/4                 then the triangles between it and the row before
//! ...
//! # end 960 1856                      the number of v lines and of f lines
//! ```
//!
//! The last line says that nothing is missing: a program that died upstream leaves an OBJ without
//! it. Indices count from 1. There are neither groups nor smoothing groups, as every
//! corner has its normal. Numbers are the shortest decimals that read back to the same f32, without
//! exponents; zero is always written `0`.

use crate::triangulator::{Counts, Sink};
use crate::{Options, Triangle};
use std::io::{self, Write};

/// The first line of an OBJ of ours. A file that starts with it ends with `# end V F`, or is cut.
pub const FIRST_LINE: &str = "# topobook triangulate OBJ 1";

/// Writes a mesh as OBJ while it is made.
#[derive(Debug)]
pub struct ObjWriter<W> {
    out: W,
    /// What was said since the last row.
    text: Vec<u8>,
}

impl<W: Write> ObjWriter<W> {
    /// A writer to `out`, which gets one write a row and need not be buffered.
    pub fn new(name: &str, options: &Options, out: W) -> Self {
        let Options { texture, surface } = options;
        let name = object_name(name);
        let text = format!("{FIRST_LINE}\no {name}\nusemtl tex{texture}_surf{surface}\n");
        Self { out, text: text.into_bytes() }
    }

    /// Writes the closing comment. Without this call the file stays marked as cut.
    ///
    /// # Errors
    /// When the output fails.
    pub fn finish(mut self, counts: &Counts) -> io::Result<()> {
        let Counts { positions, triangles, .. } = counts;
        writeln!(self.text, "# end {positions} {triangles}")?;
        self.row_done()?;
        self.out.flush()
    }

    fn numbers(&mut self, keyword: &str, numbers: &[f32]) {
        self.text.extend_from_slice(keyword.as_bytes());
        for number in numbers {
            // Writing to a vector does not fail.
            let _ = write!(self.text, " {number}");
        }
        self.text.push(b'\n');
    }
}

impl<W: Write> Sink for ObjWriter<W> {
    fn position(&mut self, position: [f32; 3]) {
        self.numbers("v", &position);
    }

    fn uv(&mut self, uv: [f32; 2]) {
        self.numbers("vt", &uv);
    }

    fn normal(&mut self, normal: [f32; 3]) {
        self.numbers("vn", &normal);
    }

    fn triangle(&mut self, triangle: &Triangle) {
        self.text.push(b'f');
        for corner in 0..3 {
            for (separator, index) in
                [(b' ', triangle.position), (b'/', triangle.uv), (b'/', triangle.normal)]
            {
                self.text.push(separator);
                push_index(&mut self.text, index[corner]);
            }
        }
        self.text.push(b'\n');
    }

    fn row_done(&mut self) -> io::Result<()> {
        self.out.write_all(&self.text)?;
        self.text.clear();
        Ok(())
    }
}

/// Appends `index` as OBJ counts, from 1.
fn push_index(text: &mut Vec<u8>, index: u32) {
    let mut digits = [0; 10];
    let mut start = digits.len();
    let mut rest = u64::from(index) + 1;
    while rest > 0 {
        start -= 1;
        digits[start] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    text.extend_from_slice(&digits[start..]);
}

/// The name as one word that no OBJ reader takes apart: blanks, control characters, comment signs
/// and line continuations become `_`.
#[must_use]
pub fn object_name(name: &str) -> String {
    let safe = |c: char| {
        if c.is_whitespace() || c.is_control() || matches!(c, '#' | '\\') { '_' } else { c }
    };
    if name.is_empty() { "unnamed".into() } else { name.chars().map(safe).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_becomes_one_word() {
        assert_eq!(object_name("my vase\t#2\n\\"), "my_vase__2__");
        assert_eq!(object_name(""), "unnamed");
        assert_eq!(object_name("Väse"), "Väse");
    }

    #[test]
    fn indices_count_from_one() {
        for index in [0, 8, 9, 99, u32::MAX] {
            let mut text = Vec::new();
            push_index(&mut text, index);
            assert_eq!(String::from_utf8(text).unwrap(), (u64::from(index) + 1).to_string());
        }
    }
}
