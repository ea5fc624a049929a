//! The readers that the fuzzer tries, one file for each kind of work after reading.
//!
//! A reader has a name, seeds, a mutator, and work to do with an input. A new reader needs a member
//! of [`Reader`], an arm in its functions in this file, and a file of this folder for its work.

pub mod areas;
pub mod grid;
pub mod job;
pub mod mesh;
pub mod picture;
pub mod scene;
pub mod seeds;
pub mod spec;
pub mod trap;
pub mod words;

use crate::dice;
use crate::seeds::{Corpus, SeedError};
use crate::verdict::Tried;
use seeds::Seeds;
use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::str::FromStr;

/// A reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reader {
    /// A spec of `sweep`.
    Spec,
    /// A path of SVG in a spec.
    Svg,
    /// An SVG file that a spec names.
    Drawing,
    /// A table of points that a spec names.
    Csv,
    /// A tree of neurites that a spec names.
    Swc,
    /// A picture of depths that a spec names.
    Depth,
    /// A grid of binary rows.
    Grid,
    /// A grid of rows as text.
    GridText,
    /// A file of areas.
    Areas,
    /// A mesh.
    Obj,
    /// A mesh as an STL file.
    Stl,
    /// A mesh as a PLY file.
    Ply,
    /// A mesh as a binary glTF file.
    Glb,
    /// A mesh as a glTF file of JSON.
    Gltf,
    /// A material library.
    Mtl,
    /// A scene.
    Scene,
    /// A part that a scene includes.
    Part,
    /// A job of `pipeline`.
    Job,
    /// A PNG file, as a texture, as a bump and in a comparison.
    Png,
    /// A JPEG file, as a texture.
    Jpeg,
    /// An EXR file in a comparison.
    Exr,
    /// Sizes, bytes and other words of command lines.
    Words,
    /// Fails in every manner on purpose. This reader tests the fuzzer and is tried only if it is
    /// named.
    Trap,
}

impl Reader {
    /// All readers that are tried when none is named.
    pub const ALL: [Self; 22] = [
        Self::Spec,
        Self::Svg,
        Self::Drawing,
        Self::Csv,
        Self::Swc,
        Self::Depth,
        Self::Grid,
        Self::GridText,
        Self::Areas,
        Self::Obj,
        Self::Stl,
        Self::Ply,
        Self::Glb,
        Self::Gltf,
        Self::Mtl,
        Self::Scene,
        Self::Part,
        Self::Job,
        Self::Png,
        Self::Jpeg,
        Self::Exr,
        Self::Words,
    ];

    /// Returns the name of the reader on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Spec => "spec",
            Self::Svg => "svg",
            Self::Drawing => "drawing",
            Self::Csv => "csv",
            Self::Swc => "swc",
            Self::Depth => "depth",
            Self::Grid => "grid",
            Self::GridText => "grid-text",
            Self::Areas => "areas",
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Glb => "glb",
            Self::Gltf => "gltf",
            Self::Mtl => "mtl",
            Self::Scene => "scene",
            Self::Part => "part",
            Self::Job => "job",
            Self::Png => "png",
            Self::Jpeg => "jpeg",
            Self::Exr => "exr",
            Self::Words => "words",
            Self::Trap => "trap",
        }
    }

    /// Returns the extension of the reader's files.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Spec | Self::Areas | Self::Scene | Self::Part | Self::Job => "json",
            Self::Svg | Self::Words | Self::Trap => "txt",
            Self::Drawing => "svg",
            Self::Csv => "csv",
            Self::Swc => "swc",
            Self::Grid | Self::GridText => "grid",
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Glb => "glb",
            Self::Gltf => "gltf",
            Self::Mtl => "mtl",
            Self::Depth | Self::Png => "png",
            Self::Jpeg => "jpg",
            Self::Exr => "exr",
        }
    }
}

impl Display for Reader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Reader {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL
            .into_iter()
            .chain([Self::Trap])
            .find(|reader| reader.name() == name)
            .ok_or_else(|| format!("expected one of {}", Self::ALL.map(Self::name).join(", ")))
    }
}

/// All readers with their seeds.
#[derive(Debug)]
pub struct Bench {
    corpus: Corpus,
    seeds: BTreeMap<Reader, Seeds>,
}

impl Bench {
    /// Loads the seeds.
    ///
    /// # Errors
    /// When a seed cannot be read.
    pub fn load() -> Result<Self, SeedError> {
        let corpus = Corpus::load()?;
        let of = |reader: Reader| Seeds::of(reader, &corpus).map(|seeds| (reader, seeds));
        let all = Reader::ALL.into_iter().chain([Reader::Trap]);
        let seeds = all.map(of).collect::<Result<_, _>>()?;
        Ok(Self { corpus, seeds })
    }

    /// Returns the input of a case. The input depends on the seed, the reader and the case alone.
    #[must_use]
    pub fn input(&self, reader: Reader, seed: u64, case: u64) -> Vec<u8> {
        let mut dice = dice::of_case(seed, reader.name(), case);
        self.seeds[&reader].input(&mut dice)
    }

    /// Returns the seeds of a reader as files.
    #[must_use]
    pub fn seeds(&self, reader: Reader) -> Vec<Vec<u8>> {
        self.seeds[&reader].files()
    }

    /// Reads an input and does some of the work that follows.
    ///
    /// # Errors
    /// With the reader's message when the reader refuses the input, or with the fault of the
    /// result.
    pub fn read(&self, reader: Reader, bytes: &[u8]) -> Tried {
        let corpus = &self.corpus;
        match reader {
            Reader::Spec => spec::read(bytes, &corpus.stored),
            Reader::Svg => spec::read_path(bytes, &corpus.stored),
            Reader::Drawing => spec::read_drawing(bytes, &corpus.stored),
            Reader::Csv => spec::read_table(bytes, &corpus.stored),
            Reader::Swc => spec::read_neurites(bytes, &corpus.stored),
            Reader::Depth => spec::read_depths(bytes, &corpus.stored),
            Reader::Grid | Reader::GridText => grid::read(bytes),
            Reader::Areas => areas::read(bytes, &corpus.grids),
            Reader::Obj => mesh::read_obj(bytes, &corpus.stored),
            Reader::Stl | Reader::Ply | Reader::Glb | Reader::Gltf => {
                mesh::read_file(reader.ending(), bytes, &corpus.stored)
            }
            Reader::Mtl => mesh::read_mtl(bytes, &corpus.stored),
            Reader::Scene => scene::read(bytes, &corpus.stored),
            Reader::Part => scene::read_part(bytes, &corpus.stored),
            Reader::Job => job::read(bytes, &corpus.stored),
            Reader::Png => picture::read_png(bytes, &corpus.stored),
            Reader::Jpeg => picture::read_jpeg(bytes, &corpus.stored),
            Reader::Exr => picture::compare(bytes),
            Reader::Words => words::read(bytes),
            Reader::Trap => trap::read(bytes),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Stop;

    #[test]
    fn every_reader_takes_its_own_seeds() {
        let bench = Bench::load().unwrap();
        for reader in Reader::ALL {
            let seeds = bench.seeds(reader);
            let mut taken = 0;
            let mut refusals = Vec::new();
            for seed in &seeds {
                match bench.read(reader, seed) {
                    Ok(()) => taken += 1,
                    Err(Stop::Refused(message)) => refusals.push(message),
                    Err(Stop::Broken(message)) => panic!("{reader}: {message}"),
                }
            }
            // Some seeds must be refused: pictures with alpha, for example.
            assert!(!seeds.is_empty() && 4 * taken >= 3 * seeds.len(), "{reader}: {refusals:#?}");
        }
    }

    #[test]
    fn a_case_is_the_same_input_each_time_and_two_cases_differ() {
        let [first, second] = [Bench::load().unwrap(), Bench::load().unwrap()];
        for reader in Reader::ALL {
            let inputs = |bench: &Bench| -> Vec<Vec<u8>> {
                (0..20).map(|case| bench.input(reader, 5, case)).collect()
            };
            let mut made = inputs(&first);
            assert_eq!(made, inputs(&second), "{reader}");
            made.sort();
            made.dedup();
            assert!(made.len() > 10, "{reader}");
        }
    }

    #[test]
    fn the_names_of_readers_are_read_back() {
        assert!(Reader::ALL.into_iter().all(|reader| reader.name().parse() == Ok(reader)));
        assert!("sep".parse::<Reader>().is_err());
    }
}
