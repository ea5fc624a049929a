//! Joints of a trajectory that turn, found and described.

use crate::curve::Path;
use crate::curve::path::Joint;
use crate::trajectory::CORNER_DEG;
use glam::DVec3;

/// Returns the corners of a path, in their order.
pub(super) fn corners_of(curve: &Path<DVec3>) -> impl Iterator<Item = Joint> {
    curve.joints().filter(|joint| joint.angle.to_degrees() > CORNER_DEG)
}

/// Describes a corner or a cusp in words.
pub(super) fn described(joint: &Joint) -> String {
    let ([before, after], degrees) = (joint.sources, joint.angle.to_degrees());
    if before == after && joint.s > 0.0 {
        format!("a cusp of {degrees:.1} degrees inside segment {after}")
    } else {
        format!("a corner of {degrees:.1} degrees where segment {before} meets segment {after}")
    }
}
