//! The flag that chooses the filter of textures.

use clap::Args;
use render::filter::Filter;

#[derive(Debug, Args)]
pub struct TextureArguments {
    /// How textures are averaged
    #[arg(long, default_value = "tent")]
    pub filter: Filter,
}
