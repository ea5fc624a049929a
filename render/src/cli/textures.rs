//! The flag that chooses the filter of textures.

use clap::Args;
use render::filter::Filter;

#[derive(Debug, Args)]
pub struct TextureArguments {
    /// Filter that averages textures
    #[arg(long, default_value = "exact")]
    pub filter: Filter,
}
