//! TrackMate's XML: spots with outlines, and tracks as links between them.

mod bounded;
mod chains;
mod elements;
mod model;
mod spot;

use super::Found;
use crate::gather::{Gather, Key};
use crate::input::Input;
use crate::scale::{Said, Scale};
use crate::{Apart, Error, Note, Options, Place, Result};
use chains::{Chain, chains};
use model::Model;
use std::collections::HashSet;

/// Outlines in the unit of the file (`Model[@spatialunits]`): vertices relative to the position of their spot. Tracks are followed
/// through their links and cut where a cell divides or cells merge.
pub(super) fn read(input: Input, options: &Options) -> Result<Found> {
    let place = input.place.clone();
    let model = elements::read(input, options.limits)?;
    let mut notes = Vec::new();
    let (tracks, filtered) = model.tracks();
    let mut gather = Gather::new(options.limits);
    let (mut used, mut bad) = (HashSet::new(), 0);
    for track in tracks {
        let (chains, lost) = chains(track, &model, &mut notes);
        bad += lost;
        for chain in &chains {
            outlines(chain, &model, &mut gather, &place)?;
            used.extend(chain.spots.iter().copied());
        }
    }
    let (cells, more) = gather.finish(&place, Apart::Names(""))?;
    notes.extend(more);
    let file = place.path().display().to_string();
    let outlined = model.spots.values().filter(|spot| !spot.points.is_empty()).count();
    if outlined == 0 {
        return Err(no_outlines(&model, &place));
    }
    let alone = model.spots.iter().filter(|(id, spot)| !spot.points.is_empty() && !used.contains(id)).count();
    let name = || file.clone();
    let without = model.spots.len() - outlined;
    notes.extend((without > 0).then(|| Note::WithoutOutline { file: name(), count: without }));
    notes.extend((alone > 0 && filtered == 0).then(|| Note::WithoutTrack { file: name(), count: alone }));
    notes.extend((filtered > 0).then(|| Note::FilteredTracks { file: name(), count: filtered }));
    notes.extend((bad > 0).then(|| Note::BadLinks { file: name(), count: bad }));
    Ok(Found { cells, notes, scale: scale(&model), image: model.image })
}

fn outlines(chain: &Chain, model: &Model, gather: &mut Gather, place: &Place) -> Result<()> {
    for id in &chain.spots {
        let Some(spot) = model.spots.get(id).filter(|spot| !spot.points.is_empty()) else { continue };
        gather.outline(Key { cell: &chain.name, frame: spot.frame }, spot.t, &spot.points, place)?;
    }
    Ok(())
}

fn no_outlines(model: &Model, place: &Place) -> Error {
    let reason = match model.spots.len() {
        0 => "the file has no spots".to_owned(),
        count => format!("its {count} spots are points; use a detector that stores outlines (ROI_N_POINTS)"),
    };
    Error::NoOutlines { file: place.path().to_owned(), reason }
}

fn scale(model: &Model) -> Scale {
    let length = Said { step: model.pixel_size, unit: model.length_unit.clone(), applied: true };
    let timed = model.spots.values().all(|spot| spot.t.is_some());
    let time = Said { step: model.interval, unit: model.time_unit.clone(), applied: timed };
    Scale { length, time }
}
