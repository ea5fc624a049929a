//! The random word in the address of the page.

use super::folder::Folder;
use super::server::ServerError;
use files::{FileError, Report};
use std::path::Path;

/// The name of the file that keeps the token of a fixed port.
const FILE: &str = ".topobook-studio";

/// Returns a random word of 32 hexadecimal digits.
///
/// # Errors
/// When the system gives no random bytes.
pub fn drawn() -> Result<String, ServerError> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|error| ServerError::System(error.to_string()))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Returns the token of a fixed port, by which a page finds the program again after a new start. A file of the folder
/// that only the user can read keeps it.
///
/// # Errors
/// When the file cannot be written.
pub fn kept(folder: &Folder) -> Result<String, Report> {
    let path = folder.inside(Path::new(FILE))?;
    if let Ok(text) = std::fs::read_to_string(&path)
        && text.len() == 32
        && text.bytes().all(|byte| byte.is_ascii_hexdigit())
    {
        return Ok(text);
    }
    let token = drawn()?;
    let failed = |source| FileError::Write { name: FILE.into(), source };
    let mut options = std::fs::File::options();
    options.write(true).create(true).truncate(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let mut file = options.open(&path).map_err(failed)?;
    std::io::Write::write_all(&mut file, token.as_bytes()).map_err(failed)?;
    Ok(token)
}
