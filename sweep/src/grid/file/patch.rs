//! The number of a patch in its object.

use serde::{Deserialize, Serialize};

/// Number of a patch in its object; `[2, 3]` in a file is the second of three.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "[usize; 2]", into = "[usize; 2]")]
pub struct Patch {
    /// Number of the patch, from 1.
    pub number: usize,
    /// Number of patches in the object.
    pub of: usize,
}

impl Patch {
    /// The only patch of an object.
    pub(super) const WHOLE: Self = Self { number: 1, of: 1 };

    pub(super) fn is_whole(&self) -> bool {
        *self == Self::WHOLE
    }

    /// Returns the next patch of the object; `None` after the last, where only the first patch of another
    /// object may follow.
    pub(super) fn next(self) -> Option<Self> {
        (self.number < self.of).then(|| Self { number: self.number + 1, of: self.of })
    }
}

impl Default for Patch {
    fn default() -> Self {
        Self::WHOLE
    }
}

impl From<[usize; 2]> for Patch {
    fn from([number, of]: [usize; 2]) -> Self {
        Self { number, of }
    }
}

impl From<Patch> for [usize; 2] {
    fn from(patch: Patch) -> Self {
        [patch.number, patch.of]
    }
}

impl std::fmt::Display for Patch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "patch {} of {}", self.number, self.of)
    }
}
