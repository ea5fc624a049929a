//! Replaces the files that a spec names by their content, and copies by specs of their own.
//!
//! After this step a spec names only pictures. So the same code reads and checks curves of a spec and of a file.

use super::Reader;
use crate::curve::svg;
use crate::error::SweepError;
use crate::spec::contour::{Loops, Rule, Section, Sections};
use crate::spec::{self, Bezier, Contour, Copies, Spec, SvgFile, Trajectory};
use files::{Failure, FileError, Place, input, memory};

/// Bytes of memory that the tree of an SVG file takes for each byte of the file.
const BYTES_OF_XML: u64 = 48;

/// Most specs that copies and neurites make of one.
pub(super) const MOST_SPECS: usize = 10_000;

impl Reader<'_> {
    /// Returns the specs that a spec stands for: most often itself, with the content of its files.
    pub(super) fn loaded(&self, spec: &Spec) -> Result<Vec<Spec>, SweepError> {
        let mut spec = spec.clone();
        self.load_contour("contour", &mut spec.contour)?;
        self.load_trajectory("trajectory", &mut spec.trajectory)?;
        if let Some(spec::Frame::Guide(guide)) = &mut spec.frame {
            self.load_trajectory("frame.guide", guide)?;
        }
        let copies = spec.copies.take();
        let specs = match &spec.trajectory {
            Trajectory::Swc(swc) => self.neurites(&spec, swc)?,
            _ => vec![spec],
        };
        match copies {
            Some(copies) => self.copied(&specs, &copies),
            None => Ok(specs),
        }
    }

    fn copied(&self, specs: &[Spec], copies: &Copies) -> Result<Vec<Spec>, SweepError> {
        let most = MOST_SPECS / specs.len().max(1);
        if !(1..=most.min(1000)).contains(&copies.count) {
            let message =
                format!("found {}, expected from 1 to {} copies", copies.count, most.min(1000));
            return Err(self.fault("copies.count", message));
        }
        self.placement("copies.step", &copies.step)?;
        if let Some(spec) = specs.first() {
            self.placement("place", &spec.place)?;
        }
        let mut all = Vec::with_capacity(copies.count * specs.len());
        for copy in 0..copies.count {
            for spec in specs {
                let steps = (0..copy).flat_map(|_| copies.step.steps());
                let place = Place::List(spec.place.steps().iter().chain(steps).copied().collect());
                let name = match copy {
                    0 => spec.name.clone(),
                    _ => format!("{}-copy{}", spec.name, copy + 1),
                };
                all.push(Spec { name, place, ..spec.clone() });
            }
        }
        Ok(all)
    }

    fn load_contour(&self, path: &str, contour: &mut Contour) -> Result<(), SweepError> {
        match contour {
            Contour::SvgFile(file) => *contour = self.svg_file(&format!("{path}.svg"), file)?,
            Contour::Sections(Sections { sections, .. }) => {
                for (i, Section { contour, .. }) in sections.iter_mut().enumerate() {
                    self.load_contour(&format!("{path}.sections[{i}].contour"), contour)?;
                }
            }
            Contour::Loops(Loops { loops, named, .. }) => {
                for (i, one) in loops.iter_mut().enumerate() {
                    let path = if *named { format!("{path}.loops[{i}]") } else { path.to_owned() };
                    self.load_contour(&path, one)?;
                }
            }
            Contour::Moved(moved) => self.load_contour(path, &mut moved.contour)?,
            Contour::Circle(_)
            | Contour::Bezier(_)
            | Contour::Svg(_)
            | Contour::Free(_)
            | Contour::Polyline(_) => {}
        }
        Ok(())
    }

    fn load_trajectory(&self, path: &str, curve: &mut Trajectory) -> Result<(), SweepError> {
        match curve {
            Trajectory::Flat(flat) => {
                self.load_contour(&format!("{path}.flat.curve"), &mut flat.curve)
            }
            Trajectory::Free(measured) => self.load_points(&format!("{path}.free"), measured),
            Trajectory::Polyline(measured) => {
                self.load_points(&format!("{path}.polyline"), measured)
            }
            Trajectory::Line(_)
            | Trajectory::Circle(_)
            | Trajectory::Helix(_)
            | Trajectory::Bezier(_)
            | Trajectory::Formula(_)
            | Trajectory::Swc(_)
            | Trajectory::Rotation(_) => Ok(()),
        }
    }

    pub(super) fn svg_file(&self, path: &str, given: &SvgFile) -> Result<Contour, SweepError> {
        let key = format!("{path}.file");
        let (name, text) = self.text_file(&key, &given.file, BYTES_OF_XML)?;
        let millimetres = self.unit.map(crate::grid::Unit::millimetres);
        let elements =
            svg::drawing(&text, given.id.as_deref(), millimetres).map_err(|message| {
                let key = if message.contains(" id ") { format!("{path}.id") } else { key.clone() };
                self.fault(&key, format!("{name}: {message}"))
            })?;
        let curve = |outline: svg::Outline| {
            Contour::Bezier(Bezier {
                closed: outline.closed,
                segments: outline.segments.iter().map(|cubic| cubic.0.map(Into::into)).collect(),
            })
        };
        let element = |svg::Filled { outlines, nonzero }: svg::Filled| {
            let rule = if nonzero { Rule::Nonzero } else { Rule::EvenOdd };
            one_or_loops(outlines.into_iter().map(curve).collect(), Some(rule))
        };
        Ok(one_or_loops(elements.into_iter().map(element).collect(), None))
    }

    /// Returns the name of a file that the spec names, for messages, and its text. `each` is the memory that its content
    /// takes for each byte.
    pub(super) fn text_file(
        &self,
        key: &str,
        file: &str,
        each: u64,
    ) -> Result<(String, String), SweepError> {
        let (name, bytes) = self.named_file(key, file)?;
        let needed = each.saturating_mul(bytes.len() as u64);
        memory::of_process().check(needed, || format!("{name}: its content")).map_err(|error| {
            SweepError::TooLarge(self.document.fault(&self.whole(key), error.to_string()))
        })?;
        let text = String::from_utf8(bytes).map_err(|_| {
            self.fault(key, format!("found bytes that are not UTF-8 in {name}, expected a text"))
        })?;
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        Ok((name, text))
    }

    /// Returns the name of a file that the spec names, for messages, and its bytes.
    pub(super) fn named_file(
        &self,
        key: &str,
        file: &str,
    ) -> Result<(String, Vec<u8>), SweepError> {
        let path = self.folder.join(file);
        let name = input::name_of(&path);
        let bytes = self.source.read(&path).map_err(|error| {
            let fault = self.document.fault(&self.whole(key), error.to_string());
            match error {
                FileError::Memory(_) => SweepError::TooLarge(fault),
                error => SweepError::Named(fault, error.exit()),
            }
        })?;
        Ok((name, bytes))
    }
}

/// Returns the only contour of a list, or all of them as loops.
fn one_or_loops(mut loops: Vec<Contour>, rule: Option<Rule>) -> Contour {
    match (loops.pop(), loops.len()) {
        (Some(only), 0) => only,
        (last, _) => {
            loops.extend(last);
            Contour::Loops(Loops { loops, named: false, rule })
        }
    }
}
