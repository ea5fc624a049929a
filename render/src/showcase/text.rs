//! The text of the scene file that shows a mesh.

use super::fit::{FOV_DEG, Frame, Sphere};
use super::view::Up;
use super::{Look, Subject, direction, further_surfaces, names_textures};
use crate::shape::mesh::{NONE, Triangle};
use glam::DVec3;
use serde_json::Value;

/// Digits of a length below the radius of the mesh.
const DIGITS: i32 = 5;

/// Largest angle between two faces that shade as one, in degrees, for corners without normals.
const SMOOTH_DEG: f64 = 35.0;

/// Number of lights in the cluster. More make softer shadows and take more time.
const CLUSTER: usize = 12;

/// Radius of the cluster, in radii of the mesh. A larger cluster makes softer shadows.
const SPREAD: f64 = 0.7;

/// Distance of the cluster from the middle of the mesh, in radii. Nearer lights fade more across the ground.
const DISTANCE: f64 = 6.0;

/// Brightness of all lights of the cluster together, at the middle of the mesh.
const KEY: f64 = 0.8;

/// Angle of the cluster from the camera towards the left, and above the horizon, in degrees.
const KEY_DEG: [f64; 2] = [48.0, 48.0];

/// The weak light: angle from the camera towards the right, angle above the horizon, in degrees, and brightness. A
/// brighter one would show a second shadow.
const WEAK: [f64; 3] = [75.0, 20.0, 0.13];

/// Ambient light.
const AMBIENT: f64 = 0.3;

/// Share of the light that a surface reflects diffusely.
const DIFFUSE: f64 = 0.9;

/// Colour of the ground.
const GROUND: f64 = 0.72;

/// Colour of a mesh without one.
const PLAIN: [f64; 3] = [0.6, 0.56, 0.5];

/// Colours of further surfaces of a mesh, which repeat.
const FURTHER: [[f64; 3]; 5] =
    [[0.5, 0.1, 0.06], [0.08, 0.22, 0.4], [0.62, 0.4, 0.08], [0.12, 0.3, 0.12], [0.3, 0.12, 0.36]];

/// The scene of a mesh, before it is text.
#[derive(Debug)]
pub(super) struct Staging<'a> {
    pub(super) subject: &'a Subject<'a>,
    pub(super) look: &'a Look,
    pub(super) up: Up,
    pub(super) frame: Frame,
    pub(super) eye: DVec3,
    pub(super) sphere: Sphere,
    /// Height of the ground along the axis that points up.
    pub(super) level: f64,
    pub(super) has_ground: bool,
}

impl Staging<'_> {
    /// Returns the scene as the text of a file.
    pub(super) fn text(&self) -> String {
        let Self { frame, eye, sphere, .. } = self;
        // The middle of the picture, at the depth of the middle of the mesh.
        let target = *eye + (sphere.center - *eye).dot(frame.forward) * frame.forward;
        let mut objects = vec![self.mesh()];
        let mut materials = Vec::new();
        if self.is_painted() {
            let color = self.look.color.map_or(PLAIN, |paint| paint.0);
            let color = if self.subject.texture.is_some() && self.look.color.is_none() {
                "1".into()
            } else {
                list(color.map(|channel| channel.to_string()))
            };
            materials.push(material("body", &color));
            for (surface, color) in self.further() {
                materials.push(material(
                    &format!("body-{surface}"),
                    &list(color.map(|x| x.to_string())),
                ));
            }
        }
        if self.has_ground {
            objects.push(self.ground());
            materials
                .push(format!("\"ground\": {{ \"color\": {GROUND}, \"diffuse\": {DIFFUSE} }}"));
        }
        let textures = match self.subject.texture {
            Some(path) => {
                let path = Value::from(path.to_string_lossy());
                format!("  \"textures\": {{ \"picture\": {{ \"image\": {path} }} }},\n")
            }
            // Texture ids need a texture, which need not change the colour.
            None if names_textures(self.subject.mesh) => {
                "  \"textures\": { \"picture\": { \"checker\": { \"colors\": [1, 1] } } },\n".into()
            }
            None => String::new(),
        };
        let separated = |items: &[String]| items.join(",\n    ");
        format!(
            "{{\n  \"format\": \"tb-scene\", \"version\": 1,\n  \"camera\": {{ \"eye\": {}, \"target\": {},\n              \
             \"up\": {}, \"fov_deg\": {FOV_DEG} }},\n  \"background\": {},\n  \"ambient\": {AMBIENT},\n  \
             \"lights\": [\n    {}\n  ],\n{textures}  \"materials\": {{\n    {}\n  }},\n  \"objects\": [\n    {}\n  ]\n}}\n",
            self.point(*eye),
            self.point(target),
            vector(frame.up),
            self.background(),
            separated(&self.lights()),
            separated(&materials),
            separated(&objects),
        )
    }

    /// Returns whether the scene gives the mesh its material.
    fn is_painted(&self) -> bool {
        self.look.color.is_some() || self.subject.texture.is_some() || !self.subject.has_colors
    }

    /// Returns the surfaces of a mesh that have colours of their own.
    fn further(&self) -> Vec<(&str, [f64; 3])> {
        if self.look.color.is_some() || self.subject.texture.is_some() {
            return Vec::new();
        }
        further_surfaces(self.subject.mesh).into_iter().zip(FURTHER.into_iter().cycle()).collect()
    }

    fn mesh(&self) -> String {
        let mut keys = vec![format!("\"name\": {}", Value::from(self.subject.given))];
        if let Some(file) = self.subject.file {
            keys.push(format!("\"file\": {}", Value::from(file.to_string_lossy())));
        }
        // A mesh that is given to the scene and has all normals needs no others.
        let lacks = |triangle: &Triangle| triangle.normal[0] == NONE;
        if self.subject.file.is_some() || self.subject.mesh.mesh.triangles.iter().any(lacks) {
            keys.push(format!("\"smooth_deg\": {SMOOTH_DEG}"));
        }
        if self.is_painted() {
            keys.push("\"material\": \"body\"".into());
            let further = self.further().into_iter();
            let bound: Vec<String> =
                further.map(|(surface, _)| format!("\"{surface}\": \"body-{surface}\"")).collect();
            if !bound.is_empty() {
                keys.push(format!("\"materials\": {{ {} }}", bound.join(", ")));
            }
        }
        if self.subject.texture.is_some() || names_textures(self.subject.mesh) {
            keys.push("\"texture\": \"picture\"".into());
        }
        format!("{{ \"mesh\": {{ {} }} }}", keys.join(", "))
    }

    /// Returns the plane of the ground, below the middle of the mesh.
    fn ground(&self) -> String {
        let [right, up, front] = self.up.axes();
        let center = self.sphere.center;
        let below = center + (self.level - center.dot(up)) * up;
        let width = 2.0 * self.sphere.radius;
        let edges = [width * right, -width * front].map(|edge| self.length(edge));
        format!(
            "{{ \"plane\": {{ \"point\": {}, \"edge_u\": {}, \"edge_v\": {}, \"material\": \"ground\" }} }}",
            self.point(below),
            edges[0],
            edges[1]
        )
    }

    /// Returns the lights. The points of the cluster lie on a disk that faces the mesh, in the pattern of a sunflower.
    fn lights(&self) -> Vec<String> {
        let Sphere { center, radius } = self.sphere;
        let toward = self.toward(-KEY_DEG[0], KEY_DEG[1]);
        let (across, along) = toward.any_orthonormal_pair();
        let mut lights = Vec::new();
        // A single light stands in the middle of the disk.
        let (count, spread) = if self.subject.is_soft { (CLUSTER, SPREAD) } else { (1, 0.0) };
        let share = (1e4 * KEY / count as f64).round() / 1e4;
        for k in 0..count {
            // Points of equal areas, turned by the golden angle.
            let distance = spread * ((k as f64 + 0.5) / count as f64).sqrt();
            let turn = k as f64 * std::f64::consts::PI * (3.0 - 5f64.sqrt());
            let aside = distance * (turn.cos() * across + turn.sin() * along);
            let position = center + radius * (DISTANCE * toward + aside);
            lights.push(format!(
                "{{ \"point\": {{ \"position\": {}, \"color\": {share}, \"falloff\": {{ \"quadratic\": 1, \
                 \"reference\": {} }} }} }}",
                self.point(position),
                self.number(DISTANCE * radius)
            ));
        }
        let [azimuth, elevation, color] = WEAK;
        let direction = vector(-self.toward(azimuth, elevation));
        lights.push(format!(
            "{{ \"directional\": {{ \"direction\": {direction}, \"color\": {color} }} }}"
        ));
        lights
    }

    /// Returns the colour of the ground at the horizon, where the cluster has faded.
    fn background(&self) -> f64 {
        let [_, elevation, color] = WEAK;
        let light = AMBIENT + DIFFUSE * color * elevation.to_radians().sin();
        (1e4 * GROUND * light).round() / 1e4
    }

    /// Returns the direction from the mesh with an azimuth from the camera and an elevation above the horizon, both
    /// in degrees.
    fn toward(&self, azimuth_deg: f64, elevation_deg: f64) -> DVec3 {
        let azimuth = (self.look.view.azimuth_deg + azimuth_deg).to_radians();
        direction(self.up.axes(), azimuth, elevation_deg.to_radians())
    }

    /// Returns a length, rounded to the digits that count for a mesh of this size.
    fn number(&self, length: f64) -> String {
        rounded(length, DIGITS - self.sphere.radius.log10().floor() as i32).to_string()
    }

    fn length(&self, vector: DVec3) -> String {
        list(vector.to_array().map(|length| self.number(length)))
    }

    fn point(&self, point: DVec3) -> String {
        self.length(point)
    }
}

/// Returns a material of a mesh, with its name.
fn material(name: &str, color: &str) -> String {
    format!(
        "\"{name}\": {{ \"color\": {color}, \"diffuse\": {DIFFUSE}, \"specular\": 0.15, \"shininess\": 40 }}"
    )
}

/// Returns a direction as JSON.
fn vector(direction: DVec3) -> String {
    list(direction.to_array().map(|number| rounded(number, 6).to_string()))
}

fn list(numbers: [String; 3]) -> String {
    format!("[{}]", numbers.join(", "))
}

/// Returns a number rounded to this many digits behind the point, or before it if negative.
fn rounded(number: f64, digits: i32) -> f64 {
    let shift = 10f64.powi(digits.abs());
    let rounded = if digits >= 0 {
        (number * shift).round() / shift
    } else {
        (number / shift).round() * shift
    };
    // Numbers whose products overflow have no digits to lose; the sum turns -0 into 0.
    if rounded.is_finite() { rounded + 0.0 } else { number }
}
