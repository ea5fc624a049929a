//! Reads neurites from an SWC file: one spec for each unbranched piece.
//!
//! A line of an SWC file is a node: its number, its kind, x, y, z, a radius, and the number of its parent, -1 for none
//! (R. Cannon et al., "An on-line archive of reconstructed hippocampal neurons", 1998). Where several nodes have one
//! parent, the thickest of them continues the piece and each other one starts a piece in its parent.

use super::Reader;
use super::loaded::MOST_SPECS;
use crate::error::SweepError;
use crate::grid::Unit;
use crate::spec::{Cap, Caps, Contour, Corners, Measured, Rotation, Spec, Swc, Trajectory};
use glam::DVec3;
use std::collections::HashMap;

/// Bytes of memory that the nodes take for each byte of the file.
const BYTES_OF_A_BYTE: u64 = 16;

/// The kind of a soma.
const SOMA: u32 = 1;

/// The nodes of a soma of several points lie in its sphere, up to this factor of its radius.
const IN_SOMA: f64 = 1.001;

/// A cut of corners that is always longer than half of a leg, so that legs are cut in their middle.
const ANY_CUT: f64 = 1e50;

/// A node of the tree.
#[derive(Debug, Clone, Copy)]
struct Node {
    kind: u32,
    point: DVec3,
    radius: f64,
    /// Index of the parent.
    parent: Option<usize>,
}

impl Reader<'_> {
    /// Returns the specs of the pieces of a tree.
    pub(super) fn neurites(&self, spec: &Spec, swc: &Swc) -> Result<Vec<Spec>, SweepError> {
        let key = "trajectory.swc.file";
        let (name, text) = self.text_file(key, &swc.file, BYTES_OF_A_BYTE)?;
        let nodes =
            nodes(&text).map_err(|message| self.fault(key, format!("{name}: {message}")))?;
        for (given, other) in [(spec.scale.is_some(), "scale"), (spec.caps.is_some(), "caps")] {
            if given {
                let message = format!(
                    "found `{other}` of neurites, expected none: radii and ends are those of the file"
                );
                return Err(self.geometry(other, message));
            }
        }
        let wanted =
            |node: &Node| swc.types.as_ref().is_none_or(|types| types.contains(&node.kind));
        let mut specs = Vec::new();
        for piece in pieces(&nodes, &wanted) {
            let made = match piece {
                Piece::Soma(at) => self.soma(spec, nodes[at]),
                Piece::Run(run) => neurite(spec, &run),
            };
            let Some(made) = made else { continue };
            if specs.len() == MOST_SPECS {
                let message = format!(
                    "{name}: found more than {MOST_SPECS} pieces, expected fewer; `types` chooses some"
                );
                return Err(self.fault(key, message));
            }
            let number = specs.len() + 1;
            let name =
                if number == 1 { spec.name.clone() } else { format!("{}-{number}", spec.name) };
            specs.push(Spec { name, ..made });
        }
        if specs.is_empty() {
            let message =
                format!("{name}: found no neurites of these types, expected nodes with parents");
            return Err(self.fault(key, message));
        }
        Ok(specs)
    }

    /// Returns the spec of a soma of one point: a sphere.
    fn soma(&self, spec: &Spec, node: Node) -> Option<Spec> {
        let r = node.radius;
        let (x, y, z) = (node.point.x, node.point.y, node.point.z);
        let rotation = Rotation { origin: [x, y, z], axis: [0.0, 1.0, 0.0], angle_deg: 360.0 };
        Some(Spec {
            contour: Contour::Svg(format!("M0 {r:?}A{r:?} {r:?} 0 0 0 0 {:?}", -r)),
            trajectory: Trajectory::Rotation(rotation),
            frame: None,
            twist: None,
            caps: None,
            ..spec.clone()
        })
    }

    /// Returns the unit of a spec with neurites: that of the spec, or micrometres.
    pub(super) fn unit_of(spec: &Spec) -> Option<Unit> {
        let neurites = matches!(spec.trajectory, Trajectory::Swc(_));
        spec.unit.or(neurites.then_some(Unit::Um))
    }
}

/// Returns the spec of a piece: a tube with round ends. `None` for a piece without length.
fn neurite(spec: &Spec, run: &[(DVec3, f64)]) -> Option<Spec> {
    let mut kept: Vec<(DVec3, f64)> = Vec::with_capacity(run.len());
    for &(point, radius) in run {
        if kept.last().is_none_or(|last| last.0 != point) {
            kept.push((point, radius));
        }
    }
    (kept.len() > 1).then(|| {
        let measured = Measured {
            closed: false,
            points: kept.iter().map(|one| one.0.to_array()).collect(),
            csv: None,
            fit: None,
            radii: Some(kept.iter().map(|one| one.1).collect()),
            scales: None,
            twists: None,
            corners: Some(Corners::Round(ANY_CUT)),
        };
        let caps = Caps { start: Some(Cap::Round), end: Some(Cap::Round) };
        Spec { trajectory: Trajectory::Polyline(measured), caps: Some(caps), ..spec.clone() }
    })
}

/// Reads the lines of a file. Parents may stand after their children.
fn nodes(text: &str) -> Result<Vec<Node>, String> {
    let mut numbers: HashMap<i64, usize> = HashMap::new();
    let mut read: Vec<(usize, Node, i64)> = Vec::new();
    for (line, row) in (1..).zip(text.lines()) {
        let row = row.split('#').next().unwrap_or_default();
        let words: Vec<&str> =
            row.split([' ', '\t', ',', '\r']).filter(|word| !word.is_empty()).collect();
        if words.is_empty() {
            continue;
        }
        let [number, kind, x, y, z, radius, parent] = words[..] else {
            return Err(format!(
                "found {} values in line {line}, expected 7: number, type, x, y, z, radius, parent",
                words.len()
            ));
        };
        let whole = |word: &str| {
            let number = word
                .parse::<f64>()
                .ok()
                .filter(|number| number.fract() == 0.0 && number.abs() < 1e15);
            number
                .map(|number| number as i64)
                .ok_or_else(|| format!("found {word:?} in line {line}, expected a whole number"))
        };
        let real = |word: &str| {
            let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| format!("found {word:?} in line {line}, expected a number"))
        };
        let radius = real(radius)?;
        if radius <= 0.0 {
            return Err(format!(
                "found the radius {radius:?} in line {line}, expected a number above 0"
            ));
        }
        let point = DVec3::new(real(x)?, real(y)?, real(z)?);
        let kind = u32::try_from(whole(kind)?).map_err(|_| {
            format!("found the type {kind} in line {line}, expected one of at least 0")
        })?;
        let own = whole(number)?;
        if numbers.insert(own, read.len()).is_some() {
            return Err(format!(
                "found the number {own} a second time in line {line}, expected a number for each node"
            ));
        }
        read.push((line, Node { kind, point, radius, parent: None }, whole(parent)?));
    }
    let mut nodes: Vec<Node> = Vec::with_capacity(read.len());
    for &(line, node, parent) in &read {
        let parent = match parent {
            ..0 => None,
            parent => Some(*numbers.get(&parent).ok_or_else(|| {
                format!(
                    "found the parent {parent} in line {line}, expected the number of a node, or -1"
                )
            })?),
        };
        nodes.push(Node { parent, ..node });
    }
    match circle(&nodes) {
        Some(at) => Err(format!(
            "found a node in line {} that is an ancestor of itself, expected a tree",
            read[at].0
        )),
        None => Ok(nodes),
    }
}

/// Returns a node that is its own ancestor, if any.
fn circle(nodes: &[Node]) -> Option<usize> {
    // The walk from each node ends at a root, or at a node of an earlier walk.
    let mut walks = vec![0; nodes.len()];
    for start in 0..nodes.len() {
        let mut at = Some(start);
        while let Some(here) = at.filter(|&here| walks[here] == 0) {
            walks[here] = start + 1;
            at = nodes[here].parent;
        }
        if let Some(here) = at.filter(|&here| walks[here] == start + 1) {
            return Some(here);
        }
    }
    None
}

/// A piece of a tree.
enum Piece {
    /// A soma of one point.
    Soma(usize),
    /// Points with radii.
    Run(Vec<(DVec3, f64)>),
}

/// Returns the pieces of a tree, in the order of their first nodes.
fn pieces(nodes: &[Node], wanted: &dyn Fn(&Node) -> bool) -> Vec<Piece> {
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); nodes.len()];
    for (i, node) in nodes.iter().enumerate() {
        if let Some(parent) = node.parent {
            children[parent].push(i);
        }
    }
    let is_soma = |node: &Node| {
        node.kind == SOMA && node.parent.is_none_or(|parent| nodes[parent].kind != SOMA)
    };
    let sphere = |i: usize| {
        let center = nodes[i];
        let inside = |&child: &usize| {
            nodes[child].kind != SOMA
                || nodes[child].point.distance(center.point) <= IN_SOMA * center.radius
        };
        is_soma(&center) && children[i].iter().all(inside)
    };
    let spheres: Vec<bool> = (0..nodes.len()).map(sphere).collect();
    // A point of a soma within its sphere is no neurite.
    let within =
        |i: usize| nodes[i].kind == SOMA && nodes[i].parent.is_some_and(|parent| spheres[parent]);
    let next = |i: usize| {
        let same =
            children[i].iter().copied().filter(|&child| wanted(&nodes[child]) && !within(child));
        same.reduce(|a, b| if nodes[b].radius > nodes[a].radius { b } else { a })
    };
    let mut found = Vec::new();
    for (i, node) in nodes.iter().enumerate() {
        if !wanted(node) || within(i) {
            continue;
        }
        if spheres[i] {
            found.push(Piece::Soma(i));
            continue;
        }
        let parent = node.parent.filter(|&parent| !within(parent));
        // The thickest child of a node that is drawn continues the piece of that node.
        let continues = parent.is_some_and(|parent| {
            wanted(&nodes[parent]) && !spheres[parent] && next(parent) == Some(i)
        });
        if continues {
            continue;
        }
        let mut run: Vec<(DVec3, f64)> =
            node.parent.map(|parent| (nodes[parent].point, node.radius)).into_iter().collect();
        let mut at = Some(i);
        while let Some(here) = at {
            run.push((nodes[here].point, nodes[here].radius));
            at = next(here);
        }
        found.push(Piece::Run(run));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const TREE: &str = "# a soma with a neurite that branches\n\
        1 1 0 0 0 5 -1\n2 3 6 0 0 1 1\n3 3 12 0 0 1 2\n4 3 18 4 0 0.9 3\n5 3 18 -4 0 0.5 3\n6 3 24 -6 0 0.5 5\n";

    fn runs(text: &str, types: Option<&[u32]>) -> Vec<usize> {
        let nodes = nodes(text).unwrap();
        let wanted = |node: &Node| types.is_none_or(|types| types.contains(&node.kind));
        let length = |piece: Piece| match piece {
            Piece::Soma(_) => 0,
            Piece::Run(run) => run.len(),
        };
        pieces(&nodes, &wanted).into_iter().map(length).collect()
    }

    #[test]
    fn each_branch_is_a_piece_and_the_thickest_continues() {
        // The neurite runs from the soma over nodes 2, 3 and 4; the thin branch from node 3 over nodes 5 and 6.
        assert_eq!(runs(TREE, None), [0, 4, 3]);
        assert_eq!(runs(TREE, Some(&[3])), [4, 3]);
        let three =
            "1 1 0 0 0 5 -1\n2 1 0 5 0 5 1\n3 1 0 -5 0 5 1\n4 2 9 0 0 1 1\n5 2 12 0 0 1 4\n";
        assert_eq!(runs(three, None), [0, 3], "a soma of three points is one sphere");
    }

    #[test]
    fn lines_have_their_complaints() {
        for (text, message) in [
            ("1 1 0 0 0 5", "found 6 values in line 1"),
            ("\n1 1 0 0 0 x -1", "found \"x\" in line 2"),
            ("1 1 0 0 0 0 -1", "the radius 0.0 in line 1"),
            ("1 1 0 0 0 1 7", "the parent 7 in line 1"),
            ("1 1 0 0 0 1 -1\n1 3 0 0 1 1 1", "the number 1 a second time in line 2"),
            ("1 3 0 0 0 1 2\n2 3 0 0 1 1 1", "an ancestor of itself"),
        ] {
            let found = nodes(text).unwrap_err();
            assert!(found.contains(message), "{found}");
        }
    }
}
