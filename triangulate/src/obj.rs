//! The mesh as an OBJ file.
//!
//! ```text
//! # topobook triangulate OBJ 1        ours; the last line must be there too
//! mtllib vase.mtl                     only where a material file was asked for
//! # unit mm                           the unit of length, if the grid states one
//! o vase                              an object, or a patch of one
//! usemtl tex2_surf0                   texture id 2, surface id 0: a scene binds both
//! v 0.5 0 -1                          a row's new positions,
//! vn 1 0 0                            normals
//! vt 0.25 0                           and picture coordinates,
//! f 1/1/1 2/2/2 4/4/4                 then the triangles between it and the row before
//! ...
//! # end 960 1856                      the number of v lines and of f lines
//! ```
//!
//! An object of several sweeps has an `o` line for each; indices run on from one to the next. Each
//! change of material has a `usemtl` line. The last line shows that the file is complete: when an
//! upstream program dies, the OBJ ends without it. Indices count from 1. There are no groups and no
//! smoothing groups, because every corner has its normal. Numbers are the shortest decimals that read
//! back to the same f32, without exponents. Zero is always written `0`.

use crate::triangulator::{Counts, Sink};
use crate::{Material, Triangle};
use files::words::unseen;
use std::collections::BTreeSet;
use std::io::{self, Write};
use sweep::grid::file::Header;

/// The first line of an OBJ that `triangulate` writes. A file with this first line is complete only if
/// it ends with `# end V F`.
pub const FIRST_LINE: &str = "# topobook triangulate OBJ 1";

/// Writes a mesh as OBJ while the mesh is made.
#[derive(Debug)]
pub struct ObjWriter<W> {
    out: W,
    /// Text written since the last completed row.
    text: Vec<u8>,
    materials: BTreeSet<Material>,
}

impl<W: Write> ObjWriter<W> {
    /// Makes a writer to `out`. The writer makes one write for each row, so `out` need not be buffered.
    pub fn new(out: W) -> Self {
        Self::with_materials(None, out)
    }

    /// Makes a writer of an OBJ that names the material file `file`. Readers resolve the path from the
    /// folder of the OBJ. The path becomes one word, as in [`object_name`].
    pub fn with_materials(file: Option<&str>, out: W) -> Self {
        let library = file.map_or(String::new(), |file| format!("mtllib {}\n", object_name(file)));
        let text = format!("{FIRST_LINE}\n{library}").into_bytes();
        Self { out, text, materials: BTreeSet::new() }
    }

    /// Returns the materials named so far, sorted by ids.
    pub fn materials(&self) -> Vec<Material> {
        self.materials.iter().copied().collect()
    }

    /// Writes the closing comment. Without this call the file counts as cut short.
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
        for &number in numbers {
            self.text.push(b' ');
            push_number(&mut self.text, number);
        }
        self.text.push(b'\n');
    }
}

impl<W: Write> Sink for ObjWriter<W> {
    fn patch(&mut self, header: &Header) {
        if let (Some(unit), 1) = (header.unit, header.patch.number) {
            self.text.extend_from_slice(format!("# unit {}\n", unit.symbol()).as_bytes());
        }
        let name = object_name(&header.name);
        self.text.extend_from_slice(format!("o {name}\n").as_bytes());
    }

    fn material(&mut self, material: Material) {
        self.text.extend_from_slice(format!("usemtl {}\n", material.name()).as_bytes());
        self.materials.insert(material);
    }

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
        let mut line = Backward { bytes: [0; LONGEST_FACE], start: LONGEST_FACE };
        line.push(b'\n');
        for corner in [2, 1, 0] {
            line.push_index(triangle.normal[corner]);
            line.push(b'/');
            line.push_index(triangle.uv[corner]);
            line.push(b'/');
            line.push_index(triangle.position[corner]);
            line.push(b' ');
        }
        line.push(b'f');
        self.text.extend_from_slice(&line.bytes[line.start..]);
    }

    fn row_done(&mut self) -> io::Result<()> {
        self.out.write_all(&self.text)?;
        self.text.clear();
        Ok(())
    }
}

/// Appends the shortest decimal without exponent that reads back to `number`, which must be finite.
fn push_number(text: &mut Vec<u8>, number: f32) {
    let mut buffer = zmij::Buffer::new();
    let digits = buffer.format_finite(number).as_bytes();
    if digits.contains(&b'e') {
        // Very large and very small numbers: the standard library writes the same digits with the zeros
        // that place them.
        let _ = write!(text, "{number}");
    } else {
        text.extend_from_slice(digits.strip_suffix(b".0").unwrap_or(digits));
    }
}

/// The length of the longest `f` line: nine indices of ten digits, each with a character before it,
/// plus `f` and a newline.
const LONGEST_FACE: usize = 9 * 11 + 2;

/// A line that is filled from its end, since the digits of a number are found last digit first.
///
/// `f` lines are most of a mesh. One copy for each line, instead of one for each index, saves a fifth
/// of the time.
struct Backward {
    bytes: [u8; LONGEST_FACE],
    /// The start of the line in `bytes`.
    start: usize,
}

impl Backward {
    fn push(&mut self, byte: u8) {
        self.start -= 1;
        self.bytes[self.start] = byte;
    }

    /// Writes `index` as OBJ counts, from 1.
    fn push_index(&mut self, index: u32) {
        let mut rest = u64::from(index) + 1;
        while rest > 0 {
            self.push(b'0' + (rest % 10) as u8);
            rest /= 10;
        }
    }
}

/// Returns the name as one word that no OBJ reader splits. Blanks, invisible characters, comment signs
/// and line continuations become `_`; an empty name becomes `unnamed`.
#[must_use]
pub fn object_name(name: &str) -> String {
    let safe = |c: char| {
        if c.is_whitespace() || unseen(c) || matches!(c, '#' | '\\') { '_' } else { c }
    };
    if name.is_empty() { "unnamed".into() } else { name.chars().map(safe).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_becomes_one_word() {
        assert_eq!(object_name("my vase\t#2\n\\"), "my_vase__2__");
        assert_eq!(object_name("a\u{1b}[2J\u{202e}b"), "a_[2J_b");
        assert_eq!(object_name(""), "unnamed");
        assert_eq!(object_name("Väse"), "Väse");
    }

    #[test]
    fn numbers_are_the_shortest_decimals_without_exponents() {
        let written = |number| {
            let mut text = Vec::new();
            push_number(&mut text, number);
            String::from_utf8(text).unwrap()
        };
        for (number, expected) in [
            (0.0, "0"),
            (-2.0, "-2"),
            (0.1, "0.1"),
            (16_777_216.0, "16777216"),
            (1e9, "1000000000"),
            (1.5e-7, "0.00000015"),
            (2.5e20, "250000000000000000000"),
        ] {
            assert_eq!(written(number), expected);
        }
        // As many digits as the standard library writes, which is the fewest. Of two decimals that are
        // equally near, either may be taken. The step is odd, so prime to 2^32, and meets all
        // exponents.
        for i in 0..200_000_u32 {
            let number = f32::from_bits(i.wrapping_mul(2_654_435_761));
            if number.is_finite() {
                let text = written(number);
                assert_eq!(text.parse::<f32>().unwrap().to_bits(), number.to_bits());
                assert_eq!(text.len(), number.to_string().len(), "{text}");
                assert!(!text.contains('e'), "{text}");
            }
        }
    }

    #[test]
    fn indices_count_from_one() {
        let mut writer = ObjWriter::new(Vec::new());
        writer.text.clear();
        let most = u32::MAX;
        writer.triangle(&Triangle { position: [0, 8, 9], uv: [99, 1, 2], normal: [3, 4, 5] });
        writer.triangle(&Triangle { position: [most; 3], uv: [most; 3], normal: [most; 3] });
        let index = (u64::from(most) + 1).to_string();
        let corner = [index.as_str(); 3].join("/");
        let expected = format!("f 1/100/4 9/2/5 10/3/6\nf {corner} {corner} {corner}\n");
        assert_eq!(String::from_utf8(writer.text).unwrap(), expected);
    }
}
