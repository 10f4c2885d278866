//! Links of a track -> cells: paths without branches.

use super::model::{Model, Track};
use crate::Note;
use std::collections::BTreeMap;

/// A path through a track on which no cell divides and none merge.
pub(super) struct Chain {
    pub(super) name: String,
    /// Spots by increasing frame.
    pub(super) spots: Vec<i64>,
}

#[derive(Default)]
struct Joint {
    before: Vec<i64>,
    after: Vec<i64>,
}

/// The chains of a track, and the number of links that cannot be followed. Links have no order in the file: the frames give the direction.
///
/// A chain ends where a spot has several successors (a split) or its successor several predecessors (a merge). The name is that of the
/// track, or `track.k` where it is cut.
pub(super) fn chains(track: &Track, model: &Model, notes: &mut Vec<Note>) -> (Vec<Chain>, usize) {
    let (joints, bad) = joints(track, model);
    let frame = |id: &i64| model.spots.get(id).map_or(0, |spot| spot.frame);
    let mut order: Vec<i64> = joints.keys().copied().collect();
    order.sort_by_key(|id| (frame(id), *id));
    let alone = |ids: &[i64]| ids.len() == 1;
    // whether the link from `id` to its only successor stays within one cell
    let goes_on = |id: &i64| -> Option<i64> {
        let after = &joints.get(id)?.after;
        let next = *after.first()?;
        (alone(after) && alone(&joints.get(&next)?.before)).then_some(next)
    };
    let mut found = Vec::new();
    for id in &order {
        let joint = &joints[id];
        let (before, after) = (joint.before.len(), joint.after.len());
        let track = || track.id.clone();
        notes.extend((after > 1).then(|| Note::Split { track: track(), frame: frame(id), into: after }));
        notes.extend((before > 1).then(|| Note::Merge { track: track(), frame: frame(id), from: before }));
        let starts = match joint.before.as_slice() {
            [one] => goes_on(one).is_none(),
            _ => true,
        };
        if starts {
            found.push(std::iter::successors(Some(*id), goes_on).collect::<Vec<i64>>());
        }
    }
    let cut = found.len() > 1;
    let name = |k: usize| if cut { format!("{}.{}", track.id, k + 1) } else { track.id.clone() };
    let chains = found.into_iter().enumerate().map(|(k, spots)| Chain { name: name(k), spots });
    (chains.collect(), bad)
}

/// Neighbours in time of each spot.
fn joints(track: &Track, model: &Model) -> (BTreeMap<i64, Joint>, usize) {
    let mut joints: BTreeMap<i64, Joint> = BTreeMap::new();
    let mut links: Vec<[i64; 2]> = Vec::new();
    let mut bad = 0;
    for &[a, b] in &track.links {
        match (model.spots.get(&a), model.spots.get(&b)) {
            (Some(first), Some(second)) if first.frame < second.frame => links.push([a, b]),
            (Some(first), Some(second)) if first.frame > second.frame => links.push([b, a]),
            _ => bad += 1,
        }
    }
    links.sort_unstable();
    links.dedup();
    for [a, b] in links {
        joints.entry(a).or_default().after.push(b);
        joints.entry(b).or_default().before.push(a);
    }
    (joints, bad)
}
