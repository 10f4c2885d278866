//! The option of threads, shared by the commands that have many independent rows.

use clap::Args;
use motiform_lab::pool::all_cores;

#[derive(Args)]
pub(crate) struct ThreadOptions {
    /// Number of threads (default: all cores); does not affect the results
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_hyphen_values = true)]
    threads: Option<u16>,
}

impl ThreadOptions {
    /// Their number.
    pub(crate) fn count(&self) -> usize {
        self.threads.map_or_else(all_cores, usize::from)
    }
}
