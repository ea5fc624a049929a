//! A folder with input files, and runs of the program in it.

#![allow(dead_code, reason = "each test module uses its part of the bench")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use fixtures::program;
pub use fixtures::program::ending;
use image::{DynamicImage, ImageFormat, RgbImage};
use std::collections::BTreeSet;
use std::fs;
use std::io::Cursor;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A grey wall that fills the view and is lit by ambient light only: every pixel is `0.5 * [1,
/// 0.25, 0]`.
pub const WALL: &str = r#"{ "format": "tb-scene", "version": 1,
"camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 },
"ambient": 0.5,
"materials": { "wall": { "color": [1, 0.25, 0], "diffuse": 0 } },
"objects": [ { "rectangle": { "corner": [-2, -2, 0], "edge_u": [4, 0, 0], "edge_v": [0, 4, 0],
  "material": "wall" } } ] }"#;

/// The scene of [`WALL`] with a mesh as the wall. The command line gives the mesh.
pub const MESH_WALL: &str = r#"{ "format": "tb-scene", "version": 1,
"camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 },
"ambient": 0.5,
"materials": { "wall": { "color": [1, 0.25, 0], "diffuse": 0 } },
"objects": [ { "mesh": { "name": "wall", "material": "wall" } } ] }"#;

/// The scene of [`WALL`] with the picture `checks.png` on the wall.
pub const TEXTURED_WALL: &str = r#"{ "format": "tb-scene", "version": 1,
"camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 },
"ambient": 0.5,
"textures": { "checks": { "image": "checks.png" } },
"materials": { "wall": { "color": [1, 0.25, 0], "diffuse": 0 } },
"objects": [ { "rectangle": { "corner": [-2, -2, 0], "edge_u": [4, 0, 0], "edge_v": [0, 4, 0],
  "material": "wall", "texture": "checks" } } ] }"#;

/// The wall of [`MESH_WALL`].
pub const WALL_OBJ: &str = "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nf 1 2 3 4\n";

/// A temporary folder.
pub struct Bench {
    folder: TempDir,
}

impl Bench {
    /// Creates an empty folder.
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    /// Creates a folder with `scene.json` in it.
    pub fn with_scene(text: &str) -> Self {
        let bench = Self::new();
        bench.write("scene.json", text);
        bench
    }

    /// Writes a file to the folder.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).unwrap();
    }

    /// Returns the path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Returns the bytes of a file in the folder.
    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    /// Returns the names in the folder, hidden ones too.
    pub fn names(&self) -> BTreeSet<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    /// Returns a command that runs the program in the folder and captures its output.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_render"));
        command
            .args(arguments)
            .current_dir(self.folder.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    /// Runs the program with bytes on its standard input.
    pub fn run(&self, arguments: &[&str], input: &[u8]) -> Output {
        program::run(env!("CARGO_BIN_EXE_render").as_ref(), arguments, self.folder.path(), input)
    }

    /// Runs the program, which must succeed and print nothing.
    pub fn make(&self, arguments: &[&str], input: &[u8]) -> Output {
        let run = self.run(arguments, input);
        assert_eq!(ending(&run), (Some(0), String::new()), "{arguments:?}");
        run
    }

    /// Runs the program at an existing `out.png`. It must fail with `code` and one sentence that
    /// begins with the first of `parts` and contains the others. All files in the folder must keep
    /// their bytes, and no file may be added.
    pub fn refuse(&self, arguments: &[&str], input: &[u8], code: i32, parts: &[&str]) {
        self.write("out.png", "old");
        let before = self.names();
        let arguments = [arguments, &["-o", "out.png", "--size", "4x4"]].concat();
        let run = self.run(&arguments, input);
        let (ended, said) = ending(&run);
        assert_eq!(ended, Some(code), "{arguments:?}: {said}");
        assert_eq!(said.lines().count(), 1, "{arguments:?}: {said}");
        assert!(said.starts_with(&format!("render: {}", parts[0])), "{arguments:?}: {said}");
        for part in parts {
            assert!(said.contains(part), "{arguments:?}: `{part}` in: {said}");
        }
        assert!(run.stdout.is_empty(), "{arguments:?}");
        assert_eq!(self.read("out.png"), b"old", "{arguments:?}");
        assert_eq!(self.names(), before, "{arguments:?}");
    }
}

/// Encodes a picture as the bytes of a file.
pub fn encoded(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// Returns a picture of two by two texels, white and black.
pub fn checks() -> Vec<u8> {
    let texel = |x, y| image::Rgb([if (x + y) % 2 == 0 { 255 } else { 0 }; 3]);
    encoded(RgbImage::from_fn(2, 2, texel), ImageFormat::Png)
}
