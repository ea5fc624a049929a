//! The reference pages in `docs/reference/`: they are made from the JSON Schemas and the doc comments, and are current.
//!
//! This command makes them again:
//!
//! ```text
//! cargo test -p topobook --test integration reference::write -- --ignored
//! ```

mod examples;
mod more;
mod page;
mod prose;
mod schema;

use crate::support;
use examples::{Examples, examples};
use files::Disk;
use files::json::Document;
use fixtures::schema::documents;
use page::{Page, page};
use prose::{beyond_the_first, documentation};
use schema::Schema;
use serde_json::Value;
use std::fs;
use std::path::Path;
use sweep::Object;
use sweep::grid::file::Encoding;
use sweep::spec::Resolution;

/// A line at the top of each page.
pub const MADE: &str = "<!-- Made from the JSON Schemas and the doc comments by `cargo test -p topobook --test integration \
     reference::write -- --ignored`. Changes belong there. -->";

/// Types with a page in the gallery that shows them.
const PICTURES: [(&str, &str); 16] = [
    ("Spec.depth", "relief-vase"),
    ("Depth", "fluted-vase"),
    ("DepthImage", "relief-vase"),
    ("Sections", "sections"),
    ("Section", "sections"),
    ("WallKeys", "walled-vase"),
    ("Swc", "neurite"),
    ("Helix", "spring"),
    ("Corners", "picture-frame"),
    ("SeamKind", "klein-bottle"),
    ("Deform", "bent-tower"),
    ("Bend", "bent-tower"),
    ("Rotation", "vase"),
    ("Bezier3", "cup"),
    ("LawKeys", "twisted-column"),
    ("Area", "globe"),
];

/// Files whose documentation tells more about a type of specs or of scenes.
const ABOUT: [(&str, &str); 17] = [
    ("Contour", "sweep/src/spec/contour.rs"),
    ("Measured", "sweep/src/spec/measured.rs"),
    ("Corners", "sweep/src/spec/corners.rs"),
    ("Flat", "sweep/src/spec/flat.rs"),
    ("Helix", "sweep/src/spec/helix.rs"),
    ("Frame", "sweep/src/spec/frame.rs"),
    ("Mesh", "sweep/src/spec/resolution.rs"),
    ("WallKeys", "sweep/src/spec/wall.rs"),
    ("Caps", "sweep/src/spec/caps.rs"),
    ("Deform", "sweep/src/spec/deform.rs"),
    ("SeamKind", "sweep/src/spec/seam.rs"),
    ("SvgFile", "sweep/src/spec/svg.rs"),
    ("Csv", "sweep/src/spec/table.rs"),
    ("Copies", "sweep/src/spec/copies.rs"),
    ("Parts", "sweep/src/spec/parts.rs"),
    ("Area", "sweep/src/spec/areas.rs"),
    ("Step", "files/src/place.rs"),
];

fn read(path: &str) -> String {
    fs::read_to_string(support::root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Returns the documents of a folder, named by their paths from the root of the project.
fn of_folder(folder: &str) -> Vec<(String, Value)> {
    let named = |(path, document): (String, Value)| {
        let file = Path::new(&path).file_name().unwrap().to_str().unwrap().to_owned();
        (format!("{folder}/{file}"), document)
    };
    documents(&support::root().join(folder)).into_iter().map(named).collect()
}

/// Returns the JSON documents in the documentation of a Rust file that have a format.
fn snippets(file: &str) -> Vec<(String, Value)> {
    let whole = documentation(&read(file));
    let blocks = whole.split("```json").skip(1).map(|block| block.split("```").next().unwrap());
    let parsed = blocks.filter_map(|block| serde_json::from_str(block).ok());
    let with_format = parsed.filter(|document: &Value| document["format"].is_string());
    with_format.map(|document| (file.to_owned(), document)).collect()
}

fn specs() -> Vec<(String, Value)> {
    let mut all = of_folder("examples/curves");
    all.extend(snippets("sweep/src/spec.rs"));
    let mut files: Vec<String> = fs::read_dir(support::root().join("sweep/src/spec"))
        .unwrap()
        .map(|entry| format!("sweep/src/spec/{}", entry.unwrap().file_name().to_str().unwrap()))
        .collect();
    files.sort();
    all.extend(files.iter().flat_map(|file| snippets(file)));
    all.extend(more::documents("tb-sweep"));
    all
}

fn scenes() -> Vec<(String, Value)> {
    let mut all = of_folder("examples/scenes");
    all.extend(snippets("render/src/scene/file.rs"));
    all.extend(more::documents("tb-scene"));
    all
}

fn jobs() -> Vec<(String, Value)> {
    let mut all = of_folder("examples/pages");
    all.extend(of_folder("examples/animations"));
    all.extend(snippets("pipeline/src/job/mod.rs"));
    all.extend(more::documents("tb-job"));
    all
}

/// Returns the header lines of grids of examples.
fn headers() -> Vec<(String, Value)> {
    let folder = support::root().join("examples/curves");
    let of = |name: &str| {
        let path = folder.join(name);
        let text = fs::read(&path).unwrap();
        let document = Document::new(name, &text).unwrap();
        let object = Object::read(&document, &folder, &Disk, &Resolution::default()).unwrap();
        let mut bytes = Vec::new();
        object.write(Encoding::Json, &mut bytes).unwrap();
        let lines = bytes.split(|byte| *byte == b'\n');
        let headers = lines.filter(|line| line.starts_with(b"{\"format\""));
        let of = |line: &[u8]| {
            (format!("examples/curves/{name}"), serde_json::from_slice(line).unwrap())
        };
        headers.map(of).collect::<Vec<(String, Value)>>()
    };
    let named = ["cup.json", "globe.json", "klein-glass.json", "walled-vase.json", "letter.json"];
    let mut all: Vec<(String, Value)> = named.into_iter().flat_map(of).collect();
    all.extend(more::documents("tb-grid"));
    all
}

/// Returns a link to a picture of a type, and what its file tells about it.
fn about(name: &str) -> String {
    let picture = PICTURES
        .iter()
        .find(|(section, _)| *section == name)
        .map(|(_, page)| format!("[![{page}](../pictures/{page}.png)](../gallery.md)\n"));
    let more = ABOUT.iter().find(|(section, _)| *section == name);
    let more = more.map(|(_, file)| beyond_the_first(&read(file)));
    [picture, more].into_iter().flatten().collect::<Vec<_>>().join("\n")
}

/// A format with its schema and documents.
struct Format {
    file: &'static str,
    title: &'static str,
    schema: Value,
    documents: Vec<(String, Value)>,
    intro: String,
}

fn formats() -> [Format; 4] {
    let schema_of = |program: &str| {
        format!(
            "`{program}` prints the JSON Schema, by which editors complete and check a file that names it as `$schema`.\n\n"
        )
    };
    [
        Format {
            file: "spec.md",
            title: "Specs of curves: `tb-sweep`",
            schema: sweep::schema::of_spec(),
            documents: specs(),
            intro: schema_of("pipeline --emit-schema spec")
                + &documentation(&read("sweep/src/spec.rs")),
        },
        Format {
            file: "scene.md",
            title: "Scenes: `tb-scene`",
            schema: render::scene::schema::of_scene(),
            documents: scenes(),
            intro: schema_of("pipeline --emit-schema scene")
                + &documentation(&read("render/src/scene/file.rs")),
        },
        Format {
            file: "job.md",
            title: "Jobs: `tb-job`",
            schema: pipeline::job::schema(),
            documents: jobs(),
            intro: schema_of("pipeline --emit-schema job")
                + &documentation(&read("pipeline/src/job/mod.rs")),
        },
        Format {
            file: "grid.md",
            title: "Grids: `tb-grid`",
            schema: sweep::grid::file::schema(),
            documents: headers(),
            intro: schema_of("pipeline --emit-schema grid")
                + &documentation(&read("sweep/src/grid/file.rs")),
        },
    ]
}

fn examples_of(format: &Format) -> Examples {
    examples(Schema(&format.schema), &format.documents)
}

/// Returns all pages with their names.
fn pages() -> Vec<(String, String)> {
    let of = |format: &Format| {
        let about: &dyn Fn(&str) -> String = if ["spec.md", "scene.md"].contains(&format.file) {
            &about
        } else {
            &|_| String::new()
        };
        let page_of = Page { title: format.title, intro: format.intro.clone(), about };
        (format.file.to_owned(), page(&page_of, Schema(&format.schema), &examples_of(format)))
    };
    let mut all: Vec<(String, String)> = formats().iter().map(of).collect();
    let parts = [
        ("OBJ files of `triangulate`", "triangulate/src/obj.rs"),
        ("OBJ files that `render` reads", "render/src/scene/obj.rs"),
        ("Material files", "render/src/scene/mtl.rs"),
    ];
    let mut obj = format!("# Meshes: OBJ and MTL\n\n{MADE}\n");
    for (title, file) in parts {
        obj += &format!("\n## {title}\n\n{}\n", documentation(&read(file)));
    }
    all.push(("obj.md".into(), obj));
    all
}

#[test]
fn pages_are_current() {
    for (name, expected) in pages() {
        let path = support::root().join("docs/reference").join(&name);
        let found = fs::read_to_string(path).unwrap_or_default();
        let differs = found.lines().zip(expected.lines()).position(|(a, b)| a != b);
        assert!(
            found == expected,
            "docs/reference/{name} differs from line {} on; the doc comment of tests/reference.rs says how to make it",
            differs.unwrap_or(0) + 1
        );
    }
}

#[test]
#[ignore = "writes the pages"]
fn write() {
    let folder = support::root().join("docs/reference");
    fs::create_dir_all(&folder).unwrap();
    for (name, text) in pages() {
        fs::write(folder.join(name), text).unwrap();
    }
}

#[test]
fn every_key_has_an_example() {
    for format in formats() {
        let found = examples_of(&format);
        let lacks = |section: &str, key: &str| !found.contains_key(&(section.into(), key.into()));
        let sections = Schema(&format.schema).sections();
        let lacking: Vec<String> = sections
            .iter()
            .flat_map(|section| section.keys.iter().map(move |key| (section, key)))
            .filter(|(section, key)| lacks(&section.name, key.name))
            .map(|(section, key)| format!("{} {}", section.name, key.name))
            .collect();
        assert_eq!(lacking, Vec::<String>::new(), "{}", format.file);
    }
}

#[test]
fn every_key_has_a_meaning() {
    for format in formats() {
        let schema = Schema(&format.schema);
        for section in schema.sections() {
            for key in &section.keys {
                assert_ne!(
                    page::meaning(key, schema),
                    "",
                    "{}: {} {}",
                    format.file,
                    section.name,
                    key.name
                );
                assert_ne!(
                    schema.values(key.schema, "place"),
                    "",
                    "{}: {} {}",
                    format.file,
                    section.name,
                    key.name
                );
            }
        }
    }
}

/// The schema accepts all documents that examples are taken from, with a `$schema` of their own.
#[test]
fn examples_are_valid() {
    for format in formats() {
        assert!(jsonschema::draft202012::meta::is_valid(&format.schema), "{}", format.file);
        let validator = jsonschema::draft202012::new(&format.schema).unwrap();
        for (name, mut document) in format.documents {
            document["$schema"] = "a.schema.json".into();
            validator.validate(&document).unwrap_or_else(|error| panic!("{name}: {error}"));
        }
    }
}

#[test]
fn pictures_exist() {
    for (_, page) in PICTURES {
        let path = format!("docs/pictures/{page}.png");
        assert!(support::root().join(&path).exists(), "{path}");
    }
}
