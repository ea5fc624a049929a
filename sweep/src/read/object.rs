//! Reads a whole spec: of one sweep, or of several.

use super::Reader;
use crate::error::SweepError;
use crate::sampling::resolution::Tell;
use crate::sampling::{Object, Sweep};
use crate::spec::{FORMAT, Parts, Resolution, Spec, VERSION};
use files::json::Document;
use files::{Disk, Source};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::HashSet;
use std::path::Path;

/// The text of an object, parsed.
enum Specs {
    /// A spec of one sweep.
    One(Box<Spec>),
    /// A spec of parts.
    Several(Parts),
}

impl Object {
    /// Reads and checks a [`Spec`](crate::spec::Spec), or a spec of [`Parts`](crate::spec::Parts).
    ///
    /// Files named in the spec are relative to `folder` and are read from `source`. Each key of `overrides`
    /// replaces that key in every `mesh`.
    ///
    /// # Errors
    /// When the text is not a spec, a surface does not exist, or a file cannot be read or has the wrong
    /// content. The message states the position.
    pub fn read(
        document: &Document<'_>,
        folder: &Path,
        source: &dyn Source,
        overrides: &Resolution,
    ) -> Result<Self, SweepError> {
        Self::read_telling(document, folder, source, overrides, &|_, _| {})
    }

    /// Reads and checks a spec, as [`Object::read`] does. `tell` receives the progress of the search for cells: the
    /// number of cuts of a surface that were measured, and the largest number that may be.
    ///
    /// # Errors
    /// As [`Object::read`].
    pub fn read_telling(
        document: &Document<'_>,
        folder: &Path,
        source: &dyn Source,
        overrides: &Resolution,
        tell: Tell<'_>,
    ) -> Result<Self, SweepError> {
        let specs = specs(document)?;
        let unit = match &specs {
            Specs::One(spec) => Reader::unit_of(spec),
            Specs::Several(object) => object.unit,
        };
        let prefix = String::new();
        let reader = Reader { document, folder, source, overrides, tell, prefix, unit };
        match specs {
            Specs::One(spec) => {
                for (key, missing) in
                    [("format", spec.format.is_none()), ("version", spec.version.is_none())]
                {
                    if missing {
                        return Err(reader.fault("", format!("missing key `{key}`")));
                    }
                }
                reader.object(spec.name.clone(), &[*spec], false)
            }
            Specs::Several(object) => {
                reader.name(&object.name)?;
                if object.parts.is_empty() {
                    return Err(reader.fault("parts", "found no parts, expected at least one"));
                }
                reader.object(object.name, &object.parts, true)
            }
        }
    }
}

impl Sweep {
    /// Reads and checks a spec of one sweep. Files that it names are relative to the working folder.
    ///
    /// # Errors
    /// As [`Object::read`], and when the object has several parts.
    pub fn read(document: &Document<'_>) -> Result<Self, SweepError> {
        Self::read_in(document, Path::new(""), &Disk, &Resolution::default())
    }

    /// Reads and checks a spec of one sweep. Files that it names are relative to `folder` and are read from
    /// `source`. Each key of `overrides` replaces that key in the spec's `mesh`.
    ///
    /// # Errors
    /// As [`Sweep::read`].
    pub fn read_in(
        document: &Document<'_>,
        folder: &Path,
        source: &dyn Source,
        overrides: &Resolution,
    ) -> Result<Self, SweepError> {
        let mut parts = Object::read(document, folder, source, overrides)?.parts;
        match (parts.pop(), parts.len()) {
            (Some(sweep), 0) => Ok(sweep),
            (_, more) => {
                let message = format!("found {} parts, expected one sweep", more + 1);
                Err(document.fault("parts", message).into())
            }
        }
    }
}

/// Parses a text as a spec of one sweep or of several.
///
/// A well-formed text is parsed as the kind of spec that it is. A spec of parts fails as a spec of
/// one sweep at its key `parts`. A text with a fault is parsed again for the complaint, which names
/// another format before any key of that format.
fn specs(document: &Document<'_>) -> Result<Specs, SweepError> {
    let head = |format: Option<&str>, version: Option<u32>| {
        let known = format.is_none_or(|found| found == FORMAT);
        if known && version.is_none_or(|found| found == VERSION) {
            return Ok(());
        }
        document.expect(FORMAT, VERSION.into())
    };
    if let Ok(spec) = document.parse::<Spec>() {
        head(spec.format.as_deref(), spec.version)?;
        return Ok(Specs::One(Box::new(spec)));
    }
    if let Ok(object) = document.parse::<Parts>() {
        head(Some(&object.format), Some(object.version))?;
        return Ok(Specs::Several(object));
    }
    document.expect(FORMAT, VERSION.into())?;
    if document.parse::<Probe>().is_ok_and(|probe| probe.parts.is_some()) {
        return Ok(Specs::Several(document.parse()?));
    }
    Ok(Specs::One(Box::new(document.parse()?)))
}

/// Finds whether a text has parts, and ignores everything else.
#[derive(Deserialize)]
struct Probe {
    parts: Option<IgnoredAny>,
}

impl Reader<'_> {
    /// Returns the object of one spec, or of several parts.
    fn object(&self, name: String, given: &[Spec], several: bool) -> Result<Object, SweepError> {
        let mut object = Object {
            name,
            parts: Vec::with_capacity(given.len()),
            specs: Vec::with_capacity(given.len()),
            owners: Vec::with_capacity(given.len()),
            written: Vec::with_capacity(given.len()),
        };
        let mut names: HashSet<String> = HashSet::new();
        for (i, spec) in given.iter().enumerate() {
            let prefix = if several { format!("parts[{i}].") } else { String::new() };
            let reader = Reader { prefix, ..*self };
            if several && spec.unit.is_some() {
                let message = "found a unit in a part, expected it beside `parts`, for all of them";
                return Err(reader.fault("unit", message));
            }
            let first = object.specs.len();
            let loaded = reader.loaded(spec)?;
            let count = spec.copies.as_ref().map_or(1, |copies| copies.count);
            let each = (loaded.len() / count).max(1);
            for (k, spec) in loaded.into_iter().enumerate() {
                if names.contains(&spec.name) {
                    let message =
                        format!("found {:?} twice, expected a name for each part", spec.name);
                    return Err(reader.fault("name", message));
                }
                let sweeps = match (k >= each)
                    .then(|| reader.copied_sweeps(&object, &spec, first + k % each))
                    .transpose()?
                    .flatten()
                {
                    Some(sweeps) => sweeps,
                    None => reader.sweeps(&spec)?,
                };
                names.extend(sweeps.iter().map(|sweep| sweep.name.clone()));
                object.owners.extend(sweeps.iter().map(|_| object.specs.len()));
                object.written.push(several.then_some(i));
                object.specs.push(spec);
                object.parts.extend(sweeps);
            }
        }
        Ok(object)
    }

    /// Returns the sweeps of a copy of the spec with this index, at a place of its own. So copies have the same cells.
    /// `None` if the cells depend on the place.
    fn copied_sweeps(
        &self,
        object: &Object,
        spec: &Spec,
        index: usize,
    ) -> Result<Option<Vec<Sweep>>, SweepError> {
        let place = self.placement("place", &spec.place)?;
        let parts = object.parts.iter().zip(&object.owners).filter(|(_, owner)| **owner == index);
        let sweeps: Vec<Sweep> = parts
            .zip(1..)
            .map(|((sweep, _), number)| {
                let name =
                    if number > 1 { format!("{}-{number}", spec.name) } else { spec.name.clone() };
                Sweep { name, ..sweep.clone() }
            })
            .collect();
        let by_camera = spec.resolution.pixels.or(self.overrides.pixels).is_some();
        let same = sweeps.iter().all(|sweep| sweep.shape.place.scale == place.scale);
        let placed = |mut sweep: Sweep| {
            sweep.shape.place = place;
            sweep
        };
        Ok((same && !by_camera).then(|| sweeps.into_iter().map(placed).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::{Exit, Failure};

    fn complaint(text: &str) -> (String, Exit) {
        let document = Document::new("a.json", text.as_bytes()).unwrap();
        let error =
            Object::read(&document, Path::new(""), &Disk, &Resolution::default()).unwrap_err();
        (error.to_string(), error.exit())
    }

    #[test]
    fn what_is_wrong_in_a_part_has_its_whole_path() {
        let object = |name: &str, contour: &str| {
            format!(
                r#"{{"format": "tb-sweep", "version": 1, "name": "mug", "parts": [
{{"name": "a", "contour": {{"circle": 1}}, "trajectory": {{"line": [[0,0,0],[0,0,1]]}}, "mesh": {{"rows": 1, "cols": 3}}}},
{{"name": "{name}", "contour": {contour}, "trajectory": {{"line": [[0,0,0],[0,0,1]]}}, "mesh": {{"rows": 1, "cols": 3}}}}]}}"#
            )
        };
        let (message, exit) = complaint(&object("b", "{\"circle\": -1}"));
        assert!(
            message.starts_with("a.json:3:37: parts[1].contour.circle: found -1.0"),
            "{message}"
        );
        assert_eq!(exit, Exit::Malformed);
        let (message, _) = complaint(&object("b", "{\"circl\": 1}"));
        assert!(
            message.contains("parts[1].contour") && message.contains("did you mean"),
            "{message}"
        );
        let (message, _) = complaint(&object("a", "{\"circle\": 1}"));
        assert!(message.contains("parts[1].name: found \"a\" twice"), "{message}");
    }

    #[test]
    fn an_object_has_parts_and_a_sweep_its_format() {
        let (message, _) =
            complaint(r#"{"format": "tb-sweep", "version": 1, "name": "a", "parts": []}"#);
        assert!(message.contains("parts: found no parts"), "{message}");
        let (message, _) = complaint(
            r#"{"version": 1, "name": "a", "contour": {"circle": 1},
                "trajectory": {"line": [[0,0,0],[0,0,1]]}, "mesh": {"rows": 1, "cols": 3}}"#,
        );
        assert!(message.contains("missing key `format`"), "{message}");
    }
}
