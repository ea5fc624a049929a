//! The flags that change how a mesh is shown.

use super::{Paint, Up, View};
use clap::Args;
use std::path::PathBuf;

/// Heading of the flags in help texts.
pub const HEADING: &str = "Pictures of a mesh without a scene";

/// The flags that change how a mesh is shown without a scene of its own.
#[derive(Debug, Clone, Default, Args)]
pub struct Look {
    /// Colour of the mesh: a name such as red, #RRGGBB in sRGB, or R,G,B from 0 to 1 in linear light [default: the
    /// colours of the file, or else a warm grey]
    #[arg(help_heading = HEADING, long, value_name = "COLOR")]
    pub color: Option<Paint>,
    /// Picture on the mesh, by its texture coordinates
    #[arg(help_heading = HEADING, long = "picture", value_name = "FILE")]
    pub texture: Option<PathBuf>,
    /// Direction of the camera: front, right, back, left, top, bottom, or the angles AZ,EL in degrees, from the front
    /// towards the right and above the horizon
    #[arg(help_heading = HEADING, long, value_name = "VIEW", default_value = "30,20", allow_hyphen_values = true)]
    pub view: View,
    /// Axis of the mesh that points up [default: z for STL files of other programs, and y for all others]
    #[arg(help_heading = HEADING, long, value_name = "AXIS", allow_hyphen_values = true)]
    pub up: Option<Up>,
    /// Show the mesh without a ground
    #[arg(help_heading = HEADING, long)]
    pub no_ground: bool,
}

impl Look {
    /// Returns the flags that differ from their defaults, as a command line has them. A picture is named without its
    /// folders.
    #[must_use]
    pub fn flags(&self) -> Vec<String> {
        let mut words = Vec::new();
        if let Some(Paint([red, green, blue])) = self.color {
            words.push(format!("--color {red},{green},{blue}"));
        }
        if let Some(name) = self.texture.as_ref().and_then(|path| path.file_name()) {
            words.push(format!("--picture {}", name.to_string_lossy()));
        }
        if self.view != View::default() {
            words.push(format!("--view {},{}", self.view.azimuth_deg, self.view.elevation_deg));
        }
        if let Some(up) = self.up {
            let name = clap::ValueEnum::to_possible_value(&up);
            words.push(format!("--up {}", name.as_ref().map_or("", |value| value.get_name())));
        }
        if self.no_ground {
            words.push("--no-ground".into());
        }
        words
    }

    /// Returns a flag that was given and that only meshes without a scene have, if there is one.
    #[must_use]
    pub fn given(&self) -> Option<String> {
        let first = self.flags().into_iter().next()?;
        first.split(' ').next().map(Into::into)
    }
}
