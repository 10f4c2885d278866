//! `motiform merge`.

use crate::args::MergeOptions;
use crate::output::{End, say, warn};
use motiform_lab::answers::Scanned;
use motiform_lab::scan::{ScanFolder, Totals, merge};

pub(crate) fn run(options: &MergeOptions) -> anyhow::Result<End> {
    let merged = merge(&options.folders, &options.out, options.force)?;
    merged.notes.iter().for_each(|note| warn(note));
    for damaged in &merged.damaged {
        warn(&format!("{damaged}; it was omitted"));
    }
    let folder = ScanFolder::read(&options.out)?;
    let totals = Totals::of(&folder)?;
    say(&Scanned::new(&folder, &totals)?, options.json)?;
    if merged.missing > 0 {
        let parts = folder.plan().parts();
        warn(&format!(
            "{} of {parts} parts ({} cells) are in none of these folders: `motiform scan` with --resume --out {} \
             computes them",
            merged.missing,
            totals.missing,
            options.out.display()
        ));
    }
    Ok(if merged.missing > 0 || totals.undetermined > 0 { End::NotAsAsked } else { End::Done })
}
