//! What the tests of the whole road share: where the programs are, and how they are run.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The root of the project.
pub fn root() -> PathBuf {
    let pipeline = Path::new(env!("CARGO_MANIFEST_DIR"));
    pipeline.parent().expect("the crate lies in the workspace").to_path_buf()
}

/// The folder of the programs: the three stand beside `pipeline`, as does `pipeline-report`, which Cargo
/// builds with it.
pub fn programs() -> PathBuf {
    let folder = Path::new(env!("CARGO_BIN_EXE_pipeline")).parent().expect("a file has a folder");
    for program in ["sweep", "triangulate", "render"] {
        let path = folder.join(program).with_extension(std::env::consts::EXE_EXTENSION);
        assert!(path.exists(), "{program} is not built: run the tests of the whole workspace");
    }
    folder.to_path_buf()
}

/// Runs a program of ours in `folder`.
pub fn run(program: &str, arguments: &[&str], folder: &Path) -> Output {
    Command::new(programs().join(program))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program starts")
}

/// What a program said on standard error.
pub fn words(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
