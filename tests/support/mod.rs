//! Support for tests across crates: the programs' folder, and runs of the programs.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[cfg(unix)]
pub mod animated;
#[cfg(feature = "studio")]
pub mod http;
#[cfg(target_os = "linux")]
pub mod slurm;
#[cfg(feature = "studio")]
pub mod webdriver;

pub use fixtures::program::said;

/// Returns the root of the project.
pub fn root() -> PathBuf {
    let pipeline = Path::new(env!("CARGO_MANIFEST_DIR"));
    pipeline.parent().expect("the crate lies in the workspace").to_path_buf()
}

/// Returns the folder of the programs. The three programs are beside `pipeline`, as is
/// `pipeline-report`, which Cargo builds with it.
pub fn programs() -> PathBuf {
    let folder = Path::new(env!("CARGO_BIN_EXE_pipeline")).parent().expect("a file has a folder");
    for program in ["sweep", "triangulate", "render"] {
        let path = folder.join(program).with_extension(std::env::consts::EXE_EXTENSION);
        assert!(path.exists(), "{program} is not built: run the tests of the whole workspace");
    }
    folder.to_path_buf()
}

/// Runs one of the four programs in `folder`, with empty standard input.
pub fn run(program: &str, arguments: &[&str], folder: &Path) -> Output {
    fixtures::program::run(&programs().join(program), arguments, folder, b"")
}

/// Returns the path of programs with the project's programs in front.
pub fn path_with_programs() -> std::ffi::OsString {
    let old = std::env::var_os("PATH").unwrap_or_default();
    let folders = [programs()].into_iter().chain(std::env::split_paths(&old));
    std::env::join_paths(folders).expect("no folder's name has a colon")
}

/// Runs a command line of the shell in `folder`, with the project's programs on the path. The shell
/// stays the parent of the programs, as an interactive shell does.
#[cfg(unix)]
pub fn shell(line: &str, folder: &Path) -> Output {
    Command::new("sh")
        .args(["-c", &format!("{line}\nexit $?")])
        .env("PATH", path_with_programs())
        .current_dir(folder)
        .output()
        .expect("the shell starts")
}

/// Runs a line as [`shell`] does, in a folder where `examples` is a link to the examples.
#[cfg(unix)]
pub fn shell_beside_examples(line: &str, folder: &Path) -> Output {
    let link = folder.join("examples");
    if !link.exists() {
        std::os::unix::fs::symlink(root().join("examples"), link).expect("a link is made");
    }
    shell(line, folder)
}
