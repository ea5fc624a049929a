//! Lists the files of `examples/` that the program embeds: the pages, and all that they may name.

use std::env;
use std::error::Error;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// The folders of `examples/` whose files are embedded. Their own folders are not.
const FOLDERS: [&str; 6] = ["curves", "meshes", "pages", "scenes", "start", "textures"];

/// The extensions of embedded files.
const EXTENSIONS: [&str; 6] = ["csv", "json", "obj", "png", "svg", "swc"];

fn main() -> Result<(), Box<dyn Error>> {
    let examples = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("examples");
    let mut list = String::from("&[\n");
    for folder in FOLDERS {
        let path = examples.join(folder);
        writeln!(io::stdout(), "cargo::rerun-if-changed={}", path.display())?;
        let mut names = Vec::new();
        for entry in fs::read_dir(&path)? {
            names.push(entry?.file_name().into_string().map_err(|_| "a name is not Unicode")?);
        }
        names.retain(|name| EXTENSIONS.iter().any(|end| name.ends_with(&format!(".{end}"))));
        names.sort();
        for name in names {
            let (file, named) = (path.join(&name), format!("examples/{folder}/{name}"));
            list += &format!("({named:?}, include_bytes!({file:?}).as_slice()),\n");
        }
    }
    fs::write(Path::new(&env::var("OUT_DIR")?).join("examples.rs"), list + "]\n")?;
    Ok(())
}
