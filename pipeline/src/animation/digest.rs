//! Digests of the inputs of a frame, by which a frame that exists is known to be up to date.
//!
//! The digest of a picture contains all files that its job reads, by names relative to one another, the values
//! that are set, the mode, the size, and the version of the program. A picture file states it (the text `Inputs` of
//! a PNG), so that no list of frames is kept anywhere. It does not contain the number of threads nor the place of the
//! files.
//!
//! The hash is FNV-1a with 128 bits (G. Fowler, L. C. Noll and K.-P. Vo). It tells apart inputs that differ by
//! accident, and is no protection against forgery.

use crate::Job;
use crate::collected::placed;
use crate::job::Mode;
use files::{FileError, Source};
use render::Settings;
use render::film::encode::INPUTS;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// A hash of 128 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Digest(u128);

impl Default for Digest {
    fn default() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Digest {
    /// Returns the digest with bytes and their count added.
    #[must_use]
    pub fn and(mut self, bytes: &[u8]) -> Self {
        const PRIME: u128 = (1 << 88) + 0x13b;
        for byte in bytes.iter().chain(&(bytes.len() as u64).to_le_bytes()) {
            self.0 = (self.0 ^ u128::from(*byte)).wrapping_mul(PRIME);
        }
        self
    }

    /// Returns the digest of a picture, as text. `self` is that of all files and values of the job's frame.
    #[must_use]
    pub fn of_picture(self, job: &Job, mode: &Mode, settings: &Settings) -> String {
        let resolutions: Vec<_> =
            job.meshes.iter().map(|mesh| (&mesh.name, mesh.options, &mesh.resolution)).collect();
        let mode = (mode.filter, mode.sampling, mode.error);
        let text = format!("{mode:?} {}x{} {resolutions:?}", settings.width, settings.height);
        // Parts reach a requested error each by itself, so that their rays depend on their number.
        let parts = job.parts.filter(|_| mode.2.is_some());
        let text = parts.map_or(text.clone(), |parts| format!("{text} {} parts", parts.count));
        let all = self.and(env!("CARGO_PKG_VERSION").as_bytes()).and(text.as_bytes());
        format!("{:032x}", all.0)
    }
}

/// Files that were read from a source.
#[derive(Debug)]
pub struct Recorded<'a> {
    source: &'a dyn Source,
    /// Digests of their bytes.
    read: Mutex<BTreeMap<PathBuf, Digest>>,
}

impl<'a> Recorded<'a> {
    /// Records what is read from `source` from now on.
    #[must_use]
    pub fn new(source: &'a dyn Source) -> Self {
        Self { source, read: Mutex::default() }
    }

    fn record(&self, path: &Path, bytes: &[u8]) {
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        read.insert(path.into(), Digest::default().and(bytes));
    }

    /// Returns the digest of all files that were read. Their names are relative to the deepest folder that contains
    /// them all.
    #[must_use]
    pub fn digest(&self) -> Digest {
        let read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        let names = placed(read.keys());
        names.iter().zip(read.values()).fold(Digest::default(), |all, (name, digest)| {
            let name = name.to_string_lossy().replace('\\', "/");
            all.and(name.as_bytes()).and(&digest.0.to_le_bytes())
        })
    }
}

impl Source for Recorded<'_> {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let bytes = self.source.read(path)?;
        self.record(path, &bytes);
        Ok(bytes)
    }

    fn read_json(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let bytes = self.source.read_json(path)?;
        self.record(path, &bytes);
        Ok(bytes)
    }

    fn same_but_case(&self, path: &Path) -> Option<PathBuf> {
        self.source.same_but_case(path)
    }
}

/// Returns whether a file is a whole PNG that states this digest.
#[must_use]
pub fn is_complete(path: &Path, inputs: &str) -> bool {
    let Ok(bytes) = fs::read(path) else { return false };
    let text = [INPUTS.as_bytes(), b"\0", inputs.as_bytes()].concat();
    chunks(&bytes).is_some_and(|chunks| chunks.contains(&(*b"tEXt", text.as_slice())))
}

/// A chunk of a PNG: its kind and its data.
type Chunk<'a> = ([u8; 4], &'a [u8]);

/// Returns the chunks of a PNG, if it has its last one and nothing behind.
pub(crate) fn chunks(bytes: &[u8]) -> Option<Vec<Chunk<'_>>> {
    let mut rest = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n")?;
    let mut chunks: Vec<Chunk<'_>> = Vec::new();
    while let Some((length, behind)) = rest.split_first_chunk::<4>() {
        let (kind, behind) = behind.split_first_chunk::<4>()?;
        let (data, behind) = behind.split_at_checked(u32::from_be_bytes(*length) as usize)?;
        chunks.push((*kind, data));
        // The checksum.
        rest = behind.get(4..)?;
    }
    (chunks.last()?.0 == *b"IEND").then_some(chunks)
}

#[cfg(test)]
mod tests {
    use super::*;
    use render::Picture;
    use render::color::Encoding;
    use render::film::encode::{Coding, Format, encode_as};

    /// The value of the hash for `foobar` is that of the authors' page; here the count follows.
    #[test]
    fn the_hash_is_fnv() {
        let bytes = |text: &[u8]| {
            text.iter().fold(Digest::default().0, |hash, byte| {
                (hash ^ u128::from(*byte)).wrapping_mul((1 << 88) + 0x13b)
            })
        };
        assert_eq!(bytes(b"foobar"), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
        assert_eq!(Digest::default().and(b"foobar").0, bytes(b"foobar\x06\0\0\0\0\0\0\0"));
        // Two texts are not one.
        assert_ne!(Digest::default().and(b"ab").and(b"c"), Digest::default().and(b"a").and(b"bc"));
    }

    #[test]
    fn a_picture_is_complete_with_its_digest_and_its_end() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let coding = Coding { inputs: Some("abc".into()), ..Coding::new(Encoding::Srgb) };
        let bytes = encode_as(&Picture::black(3, 2), Format::Png, &coding).unwrap();
        assert!(!is_complete(&path, "abc"));
        for (bytes, inputs, truth) in [
            (&bytes[..], "abc", true),
            (&bytes, "abd", false),
            (&bytes, "ab", false),
            (&bytes[..bytes.len() - 1], "abc", false),
            (&bytes[..bytes.len() - 13], "abc", false),
            (&bytes[..8], "abc", false),
            (b"", "abc", false),
        ] {
            fs::write(&path, bytes).unwrap();
            assert_eq!(is_complete(&path, inputs), truth, "{} {inputs}", bytes.len());
        }
    }
}
