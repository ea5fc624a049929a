//! The seeds of each reader, and their mutators.

use super::Reader;
use crate::dice::Dice;
use crate::mutate::{bytes, exr, grid, jpeg, json, png, text};
use crate::seeds::{self, Corpus, SeedError, small};
use image::codecs::jpeg::JpegEncoder;
use serde_json::{Value, json};
use sweep::grid::file::{Encoding, write_all};
use triangulate::{TriMesh, write_glb, write_ply, write_stl};

/// Words of OBJ files.
const OBJ: [&str; 18] = [
    "v ",
    "vt ",
    "vn ",
    "f ",
    "\nf 1 2 3\n",
    "\nf 1/1/1 2/2/2 3/3/3\n",
    "o ",
    "g ",
    "s 1\n",
    "usemtl ",
    "mtllib ",
    "# end",
    "//",
    "/",
    "-1",
    "l 1 2\n",
    "\\\n",
    "\r\n",
];

/// Words of STL and PLY files.
const MESH: [&str; 16] = [
    "solid ",
    "facet normal ",
    "vertex 0 0 1 ",
    "endloop\n",
    "endsolid",
    "ply\n",
    "format ascii 1.0\n",
    "format binary_big_endian 1.0\n",
    "element vertex ",
    "element face ",
    "property float x\n",
    "property list uchar int vertex_indices\n",
    "property uchar red\n",
    "end_header\n",
    " -1 ",
    "\r",
];

/// Words of MTL files.
const MTL: [&str; 14] = [
    "newmtl ",
    "\nnewmtl a\n",
    "Kd ",
    "Ka ",
    "Ks ",
    "Ns ",
    "Ni ",
    "d ",
    "Tr ",
    "illum 2\n",
    "map_Kd ",
    "-s 1 1 1",
    "../textures/net.png",
    "\\",
];

/// Words of SVG paths.
const SVG: [&str; 22] = [
    "M", "m", "L", "l", "H", "h", "V", "v", "C", "c", "S", "s", "Q", "q", "T", "t", "A", "a", "Z",
    "z", ",", "1e",
];

/// Words of SVG files.
const DRAWING: [&str; 20] = [
    "<g>",
    "</g>",
    "<rect width='1' height='2'/>",
    "<circle r='1'/>",
    "<use href='#a'/>",
    "id='a'",
    " transform='",
    "scale(",
    "rotate(",
    "matrix(",
    "viewBox='",
    "width='",
    "mm",
    "%",
    "<defs>",
    "&lt;",
    "<!--",
    "<![CDATA[",
    "points='",
    "/>",
];

/// Words of tables.
const CSV: [&str; 10] = [",", ";", "\t", "\n", "\"", "#", "x", "1e", "nan", "-"];

/// Words of SWC files.
const SWC: [&str; 10] =
    [" ", "\n", "-1", "0", "1", "2", "#", "1e60", "\n1 1 0 0 0 1 -1\n", "\n9 3 1 1 1 1 1\n"];

/// Words of command lines.
const WORDS: [&str; 16] = [
    "x", "X", ",", ":", "k", "M", "G", "log", "linear", "640x480", "512M", "1e-4", "normal",
    "depth", "/", " ",
];

/// The seeds of a reader, split as far as its mutator needs.
#[derive(Debug)]
pub enum Seeds {
    /// JSON documents; specs and jobs among them have few cells.
    Json {
        /// The documents.
        documents: Vec<Value>,
        /// The values of the documents by keys.
        index: json::Index,
        /// Makes a mutated document small again.
        bound: fn(&mut Value),
    },
    /// Grids.
    Grids {
        /// The patches of each file.
        files: Vec<Vec<grid::Patch>>,
        /// The values of their headers by keys.
        index: json::Index,
    },
    /// Files of text, and words of their format.
    Text(Vec<Vec<u8>>, &'static [&'static str]),
    /// Files of bytes and of text, and words of their format.
    Bytes(Vec<Vec<u8>>, &'static [&'static str]),
    /// PNG files.
    Png(Vec<Vec<u8>>),
    /// JPEG files.
    Jpeg(Vec<Vec<u8>>),
    /// EXR files.
    Exr(Vec<Vec<u8>>),
}

impl Seeds {
    /// Reads the seeds of a reader.
    ///
    /// # Errors
    /// When a file of `fuzz/seeds/` cannot be read.
    pub fn of(reader: Reader, corpus: &Corpus) -> Result<Self, SeedError> {
        let extra = seeds::extra(reader.name())?;
        let text = |mut files: Vec<Vec<u8>>, words| {
            files.extend(extra.iter().cloned());
            Self::Text(files, words)
        };
        Ok(match reader {
            Reader::Spec => Self::json(corpus.specs.clone(), small::bound),
            Reader::Scene => Self::json(corpus.scenes.clone(), |_| {}),
            Reader::Part => Self::json(corpus.scenes.iter().map(part).collect(), |_| {}),
            Reader::Job => Self::json(corpus.jobs.clone(), small::bound_job),
            Reader::Areas => Self::json(areas(corpus), |_| {}),
            Reader::Grid => Self::grids(corpus, Encoding::Binary),
            Reader::GridText => Self::grids(corpus, Encoding::Json),
            Reader::Obj => {
                let all = (0..corpus.grids.len()).filter_map(|number| corpus.obj(number));
                let all = all.filter(|file| file.len() < 30_000).enumerate();
                text(
                    all.map(|(k, file)| if k % 3 == 0 { file } else { strange(&file) }).collect(),
                    &OBJ,
                )
            }
            Reader::Stl => {
                Self::Bytes(meshes(corpus, &extra, |mesh, out| write_stl(mesh, out)), &MESH)
            }
            Reader::Ply => {
                Self::Bytes(meshes(corpus, &extra, |mesh, out| write_ply(mesh, out)), &MESH)
            }
            Reader::Glb => {
                Self::Bytes(meshes(corpus, &extra, |mesh, out| write_glb(mesh, None, out)), &[])
            }
            Reader::Gltf => Self::json(seeds::documents("gltf")?, |_| {}),
            Reader::Mtl => text(Vec::new(), &MTL),
            Reader::Svg => text(paths(&corpus.specs), &SVG),
            Reader::Drawing => text(Vec::new(), &DRAWING),
            Reader::Csv => text(Vec::new(), &CSV),
            Reader::Swc => text(Vec::new(), &SWC),
            Reader::Words => text(Vec::new(), &WORDS),
            Reader::Trap => text(vec![b"fine".to_vec()], &[]),
            Reader::Depth => Self::Png(greys()),
            Reader::Png => Self::Png(seeds::png::seeds()),
            Reader::Jpeg => Self::Jpeg(jpegs()),
            Reader::Exr => Self::Exr(seeds::exr::seeds()),
        })
    }

    fn json(documents: Vec<Value>, bound: fn(&mut Value)) -> Self {
        let index = json::Index::of(&documents);
        Self::Json { documents, index, bound }
    }

    fn grids(corpus: &Corpus, encoding: Encoding) -> Self {
        let mut files = Vec::new();
        for grids in &corpus.grids {
            let mut bytes = Vec::new();
            if write_all(grids, encoding, &mut bytes).is_ok() && bytes.len() < 60_000 {
                files.push(grid::patches(&bytes));
            }
        }
        let index = json::Index::of(files.iter().flatten().map(|patch| &patch.header));
        Self::Grids { files, index }
    }

    /// Returns the seeds as files.
    #[must_use]
    pub fn files(&self) -> Vec<Vec<u8>> {
        match self {
            Self::Json { documents, .. } => {
                documents.iter().map(|document| document.to_string().into_bytes()).collect()
            }
            Self::Grids { files, .. } => files.iter().map(|patches| grid::file(patches)).collect(),
            Self::Text(files, _)
            | Self::Bytes(files, _)
            | Self::Png(files)
            | Self::Jpeg(files)
            | Self::Exr(files) => files.clone(),
        }
    }

    /// Returns a mutated seed.
    #[must_use]
    pub fn input(&self, dice: &mut Dice) -> Vec<u8> {
        match self {
            Self::Json { documents, index, bound } => {
                let mut document = dice.one(documents).clone();
                for _ in 0..=dice.below(3) {
                    json::mutate(&mut document, dice, index);
                }
                bound(&mut document);
                let other = dice.one(documents);
                json::written(&document, dice, other)
            }
            Self::Grids { files, index } => {
                let seed = dice.one(files);
                let other = dice.one(files);
                grid::mutated(seed, dice, other, index)
            }
            Self::Text(files, words) => {
                let mut file = dice.one(files).clone();
                for _ in 0..=dice.below(2) {
                    let other = dice.one(files);
                    text::mutate(&mut file, dice, words, other);
                }
                file
            }
            Self::Bytes(files, words) => {
                let mut file = dice.one(files).clone();
                for _ in 0..=dice.below(2) {
                    let other = dice.one(files);
                    if dice.once_in(2) {
                        text::mutate(&mut file, dice, words, other);
                    } else {
                        bytes::mutate(&mut file, dice, other);
                    }
                }
                file
            }
            Self::Png(files) => {
                let (seed, other) = (dice.one(files), dice.one(files));
                png::mutated(seed, dice, other)
            }
            Self::Jpeg(files) => {
                let (seed, other) = (dice.one(files), dice.one(files));
                jpeg::mutated(seed, dice, other)
            }
            Self::Exr(files) => {
                let (seed, other) = (dice.one(files), dice.one(files));
                exr::mutated(seed, dice, other)
            }
        }
    }
}

/// Returns a part with those keys of a scene that a part can have.
fn part(scene: &Value) -> Value {
    let mut part = json!({"format": "tb-scene-part", "version": 1});
    for key in ["lights", "textures", "materials", "objects"] {
        if let Some(value) = scene.get(key) {
            part[key] = value.clone();
        }
    }
    part
}

/// Returns the meshes of the corpus in a format, and further files.
fn meshes(
    corpus: &Corpus,
    extra: &[Vec<u8>],
    write: impl Fn(&TriMesh, &mut Vec<u8>) -> std::io::Result<()>,
) -> Vec<Vec<u8>> {
    let made = |number: usize| {
        let mut bytes = Vec::new();
        write(&corpus.mesh(number)?, &mut bytes).ok()?;
        (bytes.len() < 30_000).then_some(bytes)
    };
    (0..corpus.grids.len()).filter_map(made).chain(extra.iter().cloned()).collect()
}

/// Returns the mesh as other tools write it: without the comments that mark a complete file of
/// ours.
fn strange(obj: &[u8]) -> Vec<u8> {
    let lines = obj.split_inclusive(|&byte| byte == b'\n');
    lines.filter(|line| !line.starts_with(b"#")).collect::<Vec<_>>().concat()
}

/// Makes files of areas for the patches of the grids.
fn areas(corpus: &Corpus) -> Vec<Value> {
    let mut files = vec![
        json!({"format": "tb-areas", "version": 1, "areas": [
            {"rows": [0, 2], "cols": [0, 3], "texture": 2},
            {"rows": [1, 4], "cols": [2, 5], "texture": 3, "surface": 1, "repeat": [2, 1]}]}),
        json!({"format": "tb-areas", "version": 1, "areas": []}),
    ];
    for grids in corpus.grids.iter().filter(|grids| grids.len() > 1) {
        for grid in grids {
            files.push(json!({"format": "tb-areas", "version": 1, "patch": grid.name,
                "areas": [{"rows": [0, 1], "cols": [0, 2], "surface": 4, "texture": 0}]}));
        }
    }
    files
}

/// Returns the SVG paths in specs.
fn paths(specs: &[Value]) -> Vec<Vec<u8>> {
    fn find(value: &Value, found: &mut Vec<Vec<u8>>) {
        match value {
            Value::Object(object) => {
                if let Some(Value::String(path)) = object.get("svg") {
                    found.push(path.clone().into_bytes());
                }
                object.values().for_each(|value| find(value, found));
            }
            Value::Array(list) => list.iter().for_each(|value| find(value, found)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    specs.iter().for_each(|spec| find(spec, &mut found));
    found
}

/// Returns the grey pictures among the PNG seeds.
fn greys() -> Vec<Vec<u8>> {
    let is_grey = |file: &Vec<u8>| matches!(file.get(25), Some(0 | 4));
    seeds::png::seeds().into_iter().filter(is_grey).collect()
}

/// Makes small JPEG files of several qualities and colour types.
fn jpegs() -> Vec<Vec<u8>> {
    let color = image::RgbImage::from_fn(19, 17, |x, y| {
        image::Rgb([x as u8 * 13, y as u8 * 15, (x * y) as u8])
    });
    let grey = image::DynamicImage::ImageRgb8(color.clone()).into_luma8();
    let mut files = Vec::new();
    for quality in [20, 75, 100] {
        let mut bytes = Vec::new();
        if JpegEncoder::new_with_quality(&mut bytes, quality).encode_image(&color).is_ok() {
            files.push(bytes);
        }
        let mut bytes = Vec::new();
        if JpegEncoder::new_with_quality(&mut bytes, quality).encode_image(&grey).is_ok() {
            files.push(bytes);
        }
    }
    files
}
