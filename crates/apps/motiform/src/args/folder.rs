//! The folder of results, shared by the commands whose work can be resumed.

use clap::Args;
use motiform_store::Opening;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct FolderOptions {
    /// Output folder
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Go on with what is in the output folder (begin, if there is none): what an interrupted run finished is not computed again
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,
    /// Replace an earlier result; what motiform did not write stays
    #[arg(long)]
    pub(crate) force: bool,
}

impl FolderOptions {
    /// The opening of the folder: resumed, replaced, or refused where a result is there.
    pub(crate) fn opening(&self) -> Opening {
        Opening::of(self.resume, self.force)
    }
}
